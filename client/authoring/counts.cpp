#include "client/authoring/counts.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "client/authoring/json_fields.h"
#include "model/core/error.h"
#include "model/core/rounded.h"

namespace choreo::authoring {
namespace {

/// The interval of beats that contains a number, or the nearest one.
size_t IntervalAt(double place, size_t beats) {
  return static_cast<size_t>(std::clamp(std::floor(place), 0.0, static_cast<double>(beats - 2)));
}

/// How many beats a second is behind the first; two beats or more.
double PlaceAmong(double seconds, std::span<const double> beats) {
  const auto after = std::ranges::upper_bound(beats, seconds) - beats.begin();
  const size_t at = IntervalAt(static_cast<double>(after - 1), beats.size());
  return static_cast<double>(at) + (seconds - beats[at]) / (beats[at + 1] - beats[at]);
}

double SecondAt(double place, std::span<const double> beats) {
  const size_t at = IntervalAt(place, beats.size());
  return beats[at] + (place - static_cast<double>(at)) * (beats[at + 1] - beats[at]);
}

}  // namespace

double Delay::After(double seconds, std::span<const double> beats, const std::string& field) const {
  if (!counts) return seconds + amount;
  if (beats.size() < 2)
    throw InvalidArgument(field, "counts need music that has beats; say seconds");
  return SecondAt(PlaceAmong(seconds, beats) + amount, beats);
}

double Stretched(double seconds, double begin, double times, std::span<const double> beats) {
  if (beats.size() < 2) return begin + times * (seconds - begin);
  const double from = PlaceAmong(begin, beats);
  return SecondAt(from + times * (PlaceAmong(seconds, beats) - from), beats);
}

Delay ParseDelay(const std::string& text, const std::string& field, double least) {
  Delay delay;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), delay.amount);
  std::string_view unit(end, text.data() + text.size());
  if (unit.starts_with(' ')) unit.remove_prefix(1);
  delay.counts = unit == "c" || unit == "count" || unit == "counts";
  const bool known = delay.counts || unit.empty() || unit == "s";
  if (code == std::errc() && known && delay.amount >= least && delay.amount <= kMaxSeconds)
    return delay;
  throw InvalidArgument(field, '"' + text + "\" is neither seconds (2.5) nor counts (8c), from " +
                                   Rounded(least) + " on");
}

}  // namespace choreo::authoring
