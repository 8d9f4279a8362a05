#include "model/audio/beats/suggest_keys.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

double Squared(double value) { return value * value; }

constexpr int64_t kOnsetNear = 2;  // frames around a beat in which its onset is sought
constexpr int kEight = 8;          // maximum count

/// The envelope's peak near each beat, relative to the strongest. Needs at least one beat.
std::vector<double> Strengths(std::span<const int64_t> frames, std::span<const float> envelope) {
  std::vector<double> strengths;
  for (const int64_t frame : frames) {
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

void CheckCount(std::span<const double> times, int64_t count, const std::string& name) {
  const int64_t most = MostKeys(times);
  if (most == 0) {
    throw InvalidArgument(name, std::to_string(count) + " keys, but no beat is heard for them");
  }
  if (count >= 1 && count <= most) return;
  char text[160];
  std::snprintf(text, sizeof text, "%lld keys, must be 1 to %lld: %zu beats, keys %.1f s apart",
                static_cast<long long>(count), static_cast<long long>(most), times.size(),
                kMinKeyInterval);
  throw InvalidArgument(name, text);
}

double SecondOf(const BeatTrack& track, size_t beat) {
  return static_cast<double>(track.frames[beat]) / kOnsetRate;
}

/// The beat (or downbeat) nearest to a second, if any.
std::optional<size_t> BeatNear(const BeatTrack& track, double second, bool downbeat) {
  std::optional<size_t> best;
  const auto away = [&](size_t beat) { return std::abs(SecondOf(track, beat) - second); };
  for (size_t i = 0; i < track.in_bar.size(); ++i) {
    if (downbeat && track.in_bar[i] != 0) continue;
    if (!best || away(i) < away(*best)) best = i;
  }
  return best;
}

/// Counts a repeated passage like the original, however its bars are tracked now.
void CountAgain(const BeatTrack& track, const Passage& passage, size_t begin,
                std::vector<Phrase>* phrases) {
  const double lag = passage.from - passage.like;
  const double from = std::min(passage.from, SecondOf(track, begin) + lag);
  const std::vector<Phrase> before = *phrases;
  for (size_t i = begin + 1; i < track.frames.size(); ++i) {
    const double second = SecondOf(track, i);
    if (second > from && second < passage.to) (*phrases)[i] = Phrase::kBeat;
  }
  for (size_t i = begin; i < before.size(); ++i) {
    if (SecondOf(track, i) + lag >= passage.to) break;
    Phrase& again = (*phrases)[*BeatNear(track, SecondOf(track, i) + lag, false)];
    again = std::max(again, before[i]);
  }
}

}  // namespace

int64_t MostKeys(std::span<const double> times) {
  int64_t most = 0;
  double last = kNever;
  for (const double time : times) {
    if (time < kFirstKey || time - last < kMinKeyInterval) continue;
    ++most;
    last = time;
  }
  return most;
}

std::vector<Phrase> FindPhrases(const BeatTrack& track, std::span<const Passage> passages) {
  std::vector<Phrase> phrases(track.frames.size(), Phrase::kBeat);
  std::vector<size_t> begins;  // of repeated passages
  for (const Passage& passage : passages) {
    const auto beat = BeatNear(track, passage.like, true);
    if (!beat) return phrases;
    begins.push_back(*beat);
    phrases[*beat] = Phrase::kPassage;
  }
  const int bars = std::max(1, kEight / std::max(1, track.beats_in_bar));
  int nth = -1;  // index of the bar in its eight
  for (size_t i = 0; i < track.in_bar.size(); ++i) {
    if (track.in_bar[i] != 0) continue;
    const bool follows = nth >= 0 && track.in_bar[i - 1] + 1 == track.beats_in_bar;
    nth = follows && phrases[i] != Phrase::kPassage ? (nth + 1) % bars : 0;
    phrases[i] = std::max(phrases[i], nth == 0 ? Phrase::kEight : Phrase::kBar);
  }
  for (size_t i = 0; i < begins.size(); ++i) CountAgain(track, passages[i], begins[i], &phrases);
  return phrases;
}

std::vector<SuggestedKey> SuggestKeys(const BeatTrack& track, std::span<const float> onset_strength,
                                      std::span<const Passage> passages,
                                      const SuggestionRequest& request) {
  const int64_t count = request.count;
  const std::vector<double> all = track.Seconds();
  const auto part = [&](const auto& of_beats) {
    const auto first = std::ranges::lower_bound(all, request.from_s) - all.begin();
    const auto end = std::ranges::upper_bound(all, request.until_s) - all.begin();
    return std::span(of_beats).subspan(static_cast<size_t>(first),
                                       static_cast<size_t>(std::max(first, end) - first));
  };
  const std::span<const double> times = part(all);
  CheckCount(times, count, request.named);
  const auto before = static_cast<size_t>(times.data() - all.data());
  const std::vector<double> strengths = Strengths(part(track.frames), onset_strength);
  const std::vector<Phrase> all_phrases = FindPhrases(track, passages);
  const std::span<const Phrase> phrases = part(all_phrases);
  const auto worth = [&](size_t i) { return strengths[i] + static_cast<double>(phrases[i]); };
  const size_t beats = times.size();
  const double even = (times.back() - times.front()) / static_cast<double>(count);
  // Half an interval of an even spread precedes the first key and follows the last.
  const auto off_end = [&](double gap) {
    return even > 0 ? Squared(gap / (even / 2) - 1) : 0;  // 0: there is only one beat
  };

  // total[i]: the best choice so far whose last key is on beat i.
  std::vector<double> total(beats);
  for (size_t i = 0; i < beats; ++i)
    total[i] = times[i] < kFirstKey ? kNever : worth(i) - off_end(times[i] - times.front());
  std::vector<std::vector<size_t>> previous;  // [key after the first][beat]
  for (int64_t key = 1; key < count; ++key) {
    std::vector<double> best_until(total);  // the largest total up to each beat
    for (size_t i = 1; i < beats; ++i) best_until[i] = std::max(best_until[i], best_until[i - 1]);
    std::vector<double> next(beats, kNever);
    std::vector<size_t>& from = previous.emplace_back(beats, 0);
    for (size_t i = 0; i < beats; ++i) {
      for (size_t j = i; j-- > 0;) {
        const double gap = times[i] - times[j];
        if (gap < kMinKeyInterval) continue;
        const double cost = Squared(gap / even - 1);
        // Wider gaps cost more, so no earlier beat can win.
        if (gap > even && best_until[j] - cost <= next[i]) break;
        if (total[j] - cost > next[i]) {
          next[i] = total[j] - cost;
          from[i] = j;
        }
      }
      next[i] += worth(i);
    }
    total = std::move(next);
  }

  for (size_t i = 0; i < beats; ++i) total[i] -= off_end(times.back() - times[i]);
  auto beat = static_cast<size_t>(std::max_element(total.begin(), total.end()) - total.begin());
  std::vector<SuggestedKey> keys(static_cast<size_t>(count));
  for (size_t key = keys.size(); key-- > 0;) {
    keys[key] = {times[beat], before + beat, strengths[beat], phrases[beat]};
    if (key > 0) beat = previous[key - 1][beat];
  }
  return keys;
}

}  // namespace choreo
