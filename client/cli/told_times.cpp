#include "client/cli/told_times.h"

#include <cmath>
#include <regex>

#include "model/core/rounded.h"

namespace choreo::cli {
namespace {

/// Replaces what the pattern finds by its first word and the text of its number.
template <typename Text>
std::string Replaced(const std::string& message, const std::regex& pattern, const Text& text) {
  std::string replaced;
  std::string rest = message;
  for (std::smatch found; std::regex_search(rest, found, pattern); rest = found.suffix())
    replaced += found.prefix().str() + found[1].str() + text(std::stoll(found[2]));
  return replaced + rest;
}

}  // namespace

std::string ToldTimes::Of(int64_t frame) const {
  const double second = static_cast<double>(frame) / fps;
  const std::string told = Rounded(second) + " s";
  if (counts.beats.size() < 2) return told;
  const auto count_at = [&](double off) { return authoring::CountAt(second + off / fps, counts); };
  // The nearest frame to 9c is 9c.
  const double part = std::round(4 * count_at(0)) / 4;
  const bool is_part = count_at(-0.5) <= part && part <= count_at(0.5);
  const double count = is_part ? part : count_at(0);
  return count < 0 ? told : Rounded(count) + "c, " + told;
}

std::string ToldTimes::In(const std::string& message) const {
  // At most so many digits as a number of frames has.
  static const std::regex kMoment("\\b(at |from )frame (\\d{1,9})\\b"),
      kDuration("\\b(in )(\\d{1,9}) frames\\b");
  const auto duration = [this](int64_t frames) {
    return Rounded(static_cast<double>(frames) / fps) + " s";
  };
  return Replaced(Replaced(message, kMoment, [this](int64_t frame) { return Of(frame); }),
                  kDuration, duration);
}

}  // namespace choreo::cli
