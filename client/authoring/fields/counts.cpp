#include "client/authoring/fields/counts.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "client/authoring/fields/json_fields.h"
#include "model/core/error.h"
#include "model/core/rounded.h"

namespace choreo::authoring {
namespace {

/// The interval of beats that contains a number, or the nearest one.
size_t IntervalAt(double place, size_t beats) {
  return static_cast<size_t>(std::clamp(std::floor(place), 0.0, static_cast<double>(beats - 2)));
}

/// The number of beats from the first to a second; needs two beats or more.
double PlaceAmong(double seconds, std::span<const double> beats) {
  const auto after = std::ranges::upper_bound(beats, seconds) - beats.begin();
  const size_t at = IntervalAt(static_cast<double>(after - 1), beats.size());
  return static_cast<double>(at) + (seconds - beats[at]) / (beats[at + 1] - beats[at]);
}

double SecondAt(double place, std::span<const double> beats) {
  const size_t at = IntervalAt(place, beats.size());
  return beats[at] + (place - static_cast<double>(at)) * (beats[at + 1] - beats[at]);
}

void RequireBeats(double amount, const Counts& counted, const std::string& field) {
  if (counted.beats.size() >= 2) return;
  throw InvalidArgument(field, InFull(amount) + "c: " + counted.advice);
}

}  // namespace

Counts CountsFrom(std::vector<double> beats, std::span<const double> ones) {
  Counts counted{std::move(beats)};
  if (ones.empty() || counted.beats.empty()) return counted;
  const auto one = std::ranges::lower_bound(counted.beats, ones.front());
  counted.one =
      std::min(static_cast<size_t>(one - counted.beats.begin()), counted.beats.size() - 1);
  return counted;
}

double WrittenTime::After(double seconds, const Counts& counted, const std::string& field) const {
  if (!counts) return seconds + amount;
  RequireBeats(amount, counted, field);
  return SecondAt(PlaceAmong(seconds, counted.beats) + amount, counted.beats);
}

double WrittenTime::In(const Counts& counted, const std::string& field) const {
  if (!counts) return amount;
  RequireBeats(amount, counted, field);
  const double second = SecondAt(static_cast<double>(counted.one) + amount - 1, counted.beats);
  if (second >= 0) return second;
  throw InvalidArgument(field, InFull(amount) + "c is before second 0; count 1 is at " +
                                   Rounded(counted.beats[counted.one]) + " s");
}

double CountAt(double seconds, const Counts& counted) {
  return PlaceAmong(seconds, counted.beats) - static_cast<double>(counted.one) + 1;
}

double SecondOf(int64_t frame, double fps, const Counts& counted) {
  const double second = static_cast<double>(frame) / fps;
  if (counted.beats.size() < 2) return second;
  const double place = PlaceAmong(second, counted.beats);
  for (const int parts : {1, 2, 3, 4}) {
    const double simple = SecondAt(std::round(place * parts) / parts, counted.beats);
    if (FrameForKey(std::llround(simple * fps)) == frame) return simple;
  }
  return second;
}

double Stretched(double seconds, double begin, double times, std::span<const double> beats) {
  if (beats.size() < 2) return begin + times * (seconds - begin);
  const double from = PlaceAmong(begin, beats);
  return SecondAt(from + times * (PlaceAmong(seconds, beats) - from), beats);
}

WrittenTime ParseTime(const std::string& text, const std::string& field, double least) {
  WrittenTime time;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), time.amount);
  std::string_view unit(end, text.data() + text.size());
  if (unit.starts_with(' ')) unit.remove_prefix(1);
  time.counts = unit == "c" || unit == "count" || unit == "counts";
  const bool known = time.counts || unit.empty() || unit == "s";
  if (code == std::errc() && known && time.amount >= least && time.amount <= kMaxSeconds)
    return time;
  throw InvalidArgument(field, '"' + text + "\" is neither seconds (2.5) nor counts (8c), from " +
                                   Rounded(least) + " on");
}

}  // namespace choreo::authoring
