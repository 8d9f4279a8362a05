#include "model/audio/beats/beat_hint.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "model/audio/beats/same_tempo.h"

namespace choreo {
namespace {

constexpr double kTempoSlack = 1 + kSameTempo;  // either way
constexpr double kPauseBeats = 1.6;             // beats; longer gaps are pauses

/// Whole beats from beat `i` to the next: 1, or more over a pause. The gaps around tell how long a
/// beat is, as the tempo may have changed.
int64_t BeatsToNext(std::span<const int64_t> frames, size_t i) {
  constexpr size_t kGapsAround = 4;
  std::vector<int64_t> gaps;
  for (size_t k = i - std::min(i, kGapsAround); k <= i + kGapsAround && k + 1 < frames.size(); ++k)
    gaps.push_back(frames[k + 1] - frames[k]);
  const auto median = gaps.begin() + (std::ssize(gaps) - 1) / 2;
  std::ranges::nth_element(gaps, median);
  const double beats =
      static_cast<double>(frames[i + 1] - frames[i]) / static_cast<double>(*median);
  return beats > kPauseBeats ? std::llround(beats) : 1;
}

/// The place of a downbeat, by the first one in beats [begin, end), or else the first with a count.
std::optional<int64_t> DownbeatIn(const BeatTrack& track, std::span<const int64_t> places,
                                  size_t begin, size_t end) {
  if (track.in_bar.size() != places.size()) return std::nullopt;
  const auto counts = std::span(track.in_bar).subspan(begin, end - begin);
  auto told = std::ranges::find(counts, 0);
  if (told == counts.end())
    told = std::ranges::find_if(counts, [](int count) { return count > 0; });
  if (told == counts.end()) return std::nullopt;
  return places[begin + static_cast<size_t>(told - counts.begin())] - *told;
}

/// Each beat's distance, in beats, from a downbeat of its part between pauses. In a part that has
/// none the count goes on by time.
std::vector<int64_t> SinceDownbeat(const BeatTrack& track) {
  const size_t beats = track.frames.size();
  std::vector<int64_t> places(beats);
  for (size_t i = 0; i + 1 < beats; ++i) places[i + 1] = places[i] + BeatsToNext(track.frames, i);
  std::vector<int64_t> since(beats);
  int64_t downbeat = DownbeatIn(track, places, 0, beats).value_or(0);
  for (size_t begin = 0, end = 0; begin < beats; begin = end) {
    for (end = begin + 1; end < beats && places[end] == places[end - 1] + 1;) ++end;
    downbeat = DownbeatIn(track, places, begin, end).value_or(downbeat);
    for (size_t i = begin; i < end; ++i) since[i] = places[i] - downbeat;
  }
  return since;
}

void Count(std::span<const int64_t> since, BeatTrack* track) {
  const int bar = track->beats_in_bar > 0 ? track->beats_in_bar : kDefaultBar;
  track->beats_in_bar = bar;
  track->in_bar.clear();
  for (const int64_t beats : since)
    track->in_bar.push_back(static_cast<int>((beats % bar + bar) % bar));
}

void Halve(std::optional<int64_t> kept, BeatTrack* track) {
  const std::vector<int64_t> since = SinceDownbeat(*track);
  const int64_t half = kept ? since[static_cast<size_t>(NearestBeat(*track, *kept))] % 2 : 0;
  BeatTrack fewer{.beats_in_bar = track->beats_in_bar};
  std::vector<int64_t> counts;
  for (size_t i = 0; i < since.size(); ++i) {
    if ((since[i] - half) % 2 != 0) continue;
    fewer.frames.push_back(track->frames[i]);
    fewer.confidence.push_back(track->confidence[i]);
    counts.push_back((since[i] - half) / 2);
  }
  Count(counts, &fewer);
  *track = std::move(fewer);
}

void Double(BeatTrack* track) {
  const std::vector<int64_t> since = SinceDownbeat(*track);
  BeatTrack twice{.beats_in_bar = track->beats_in_bar};
  std::vector<int64_t> counts;
  const auto add = [&](int64_t frame, double confidence, int64_t count) {
    twice.frames.push_back(frame);
    twice.confidence.push_back(confidence);
    counts.push_back(count);
  };
  const std::vector<int64_t>& frames = track->frames;
  for (size_t i = 0; i < frames.size(); ++i) {
    add(frames[i], track->confidence[i], 2 * since[i]);
    if (i + 1 < frames.size() && BeatsToNext(frames, i) == 1)
      add((frames[i] + frames[i + 1]) / 2, track->confidence[i], 2 * since[i] + 1);
  }
  Count(counts, &twice);
  *track = std::move(twice);
}

}  // namespace

TempoLimits LimitsOf(const BeatHint& hint) {
  TempoLimits limits;
  if (!hint.tempo_bpm) return limits;
  limits.slowest_bpm = std::max(limits.slowest_bpm, *hint.tempo_bpm / kTempoSlack);
  limits.fastest_bpm = std::min(limits.fastest_bpm, *hint.tempo_bpm * kTempoSlack);
  return limits;
}

void Follow(const BeatHint& hint, BeatTrack* track, std::optional<int64_t> kept) {
  if (track->frames.empty()) return;
  if (hint.half_time) Halve(kept, track);
  if (hint.double_time) Double(track);
}

void CountFrom(int64_t beat, int64_t count, BeatTrack* track) {
  std::vector<int64_t> since = SinceDownbeat(*track);
  const int64_t by = count - since[static_cast<size_t>(beat)];
  for (int64_t& beats : since) beats += by;
  Count(since, track);
}

void CountOn(BeatTrack* track) { Count(SinceDownbeat(*track), track); }

int64_t NearestBeat(const BeatTrack& track, int64_t frame) {
  const auto nearest = std::ranges::min_element(
      track.frames, {}, [frame](int64_t beat) { return std::abs(beat - frame); });
  return nearest - track.frames.begin();
}

}  // namespace choreo
