#include "model/audio/suggest_keys.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

double Squared(double value) { return value * value; }

constexpr int64_t kOnsetNear = 2;  // frames around a beat in which its onset is

/// The envelope's peak near each beat, in units of the strongest.
std::vector<double> Strengths(const BeatTrack& track, std::span<const float> envelope) {
  std::vector<double> strengths;
  for (const int64_t frame : track.frames) {
    double peak = 0;
    for (int64_t f = frame - kOnsetNear; f <= frame + kOnsetNear; ++f) {
      if (f >= 0 && f < static_cast<int64_t>(envelope.size()))
        peak = std::max(peak, double{envelope[static_cast<size_t>(f)]});
    }
    strengths.push_back(peak);
  }
  const double strongest = *std::max_element(strengths.begin(), strengths.end());
  if (strongest > 0) {
    for (double& strength : strengths) strength /= strongest;
  }
  return strengths;
}

/// How many keys fit: each on the first beat that is far enough from the one before.
int64_t MostKeys(const std::vector<double>& times) {
  int64_t most = 0;
  double last = kNever;
  for (const double time : times) {
    if (time - last < kShortestKeyInterval) continue;
    ++most;
    last = time;
  }
  return most;
}

void CheckCount(const std::vector<double>& times, int64_t count, const std::string& name) {
  if (times.empty()) {
    throw InvalidArgument(
        name, std::to_string(count) + " keys, but no beat is heard that they could stand on");
  }
  const int64_t most = MostKeys(times);
  if (count >= 1 && count <= most) return;
  char text[160];
  std::snprintf(text, sizeof text, "%lld keys, must be 1 to %lld: %zu beats, keys %.1f s apart",
                static_cast<long long>(count), static_cast<long long>(most), times.size(),
                kShortestKeyInterval);
  throw InvalidArgument(name, text);
}

}  // namespace

std::vector<SuggestedKey> SuggestKeys(const BeatTrack& track, std::span<const float> onset_strength,
                                      int64_t count, const std::string& name) {
  const std::vector<double> times = track.Seconds();
  CheckCount(times, count, name);
  const std::vector<double> strengths = Strengths(track, onset_strength);
  const size_t beats = times.size();
  const double even = (times.back() - times.front()) / static_cast<double>(count);
  // Half an interval of an even spread lies before the first key and behind the last.
  const auto off_end = [&](double gap) {
    return even > 0 ? Squared(gap / (even / 2) - 1) : 0;  // 0: there is but one beat
  };

  // total[i]: the best choice so far whose last key stands on beat i.
  std::vector<double> total(beats);
  for (size_t i = 0; i < beats; ++i) total[i] = strengths[i] - off_end(times[i] - times.front());
  std::vector<std::vector<size_t>> previous;  // [key behind the first][beat]
  for (int64_t key = 1; key < count; ++key) {
    std::vector<double> best_until(total);  // the largest total up to each beat
    for (size_t i = 1; i < beats; ++i) best_until[i] = std::max(best_until[i], best_until[i - 1]);
    std::vector<double> next(beats, kNever);
    std::vector<size_t>& from = previous.emplace_back(beats, 0);
    for (size_t i = 0; i < beats; ++i) {
      for (size_t j = i; j-- > 0;) {
        const double gap = times[i] - times[j];
        if (gap < kShortestKeyInterval) continue;
        const double cost = Squared(gap / even - 1);
        // Wider gaps cost more: no beat before this one can win any more.
        if (gap > even && best_until[j] - cost <= next[i]) break;
        if (total[j] - cost > next[i]) {
          next[i] = total[j] - cost;
          from[i] = j;
        }
      }
      next[i] += strengths[i];
    }
    total = std::move(next);
  }

  for (size_t i = 0; i < beats; ++i) total[i] -= off_end(times.back() - times[i]);
  auto beat = static_cast<size_t>(std::max_element(total.begin(), total.end()) - total.begin());
  std::vector<SuggestedKey> keys(static_cast<size_t>(count));
  for (size_t key = keys.size(); key-- > 0;) {
    keys[key] = {times[beat], beat, strengths[beat]};
    if (key > 0) beat = previous[key - 1][beat];
  }
  return keys;
}

}  // namespace choreo
