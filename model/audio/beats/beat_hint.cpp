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
constexpr int64_t kNearFrames = 6;              // 70 ms: beats so near are one
constexpr double kNearlyAllBeats = 0.9;

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

/// Keeps every n-th beat.
void Divide(int64_t n, std::optional<int64_t> kept, BeatTrack* track) {
  const std::vector<int64_t> since = SinceDownbeat(*track);
  const int64_t first = kept ? since[static_cast<size_t>(NearestBeat(*track, *kept))] % n : 0;
  BeatTrack fewer{.beats_in_bar = track->beats_in_bar};
  std::vector<int64_t> counts;
  for (size_t i = 0; i < since.size(); ++i) {
    if ((since[i] - first) % n != 0) continue;
    fewer.frames.push_back(track->frames[i]);
    fewer.confidence.push_back(track->confidence[i]);
    counts.push_back((since[i] - first) / n);
  }
  Count(counts, &fewer);
  *track = std::move(fewer);
}

/// Makes n beats of each.
void Multiply(int64_t n, BeatTrack* track) {
  const std::vector<int64_t> since = SinceDownbeat(*track);
  BeatTrack more{.beats_in_bar = track->beats_in_bar};
  std::vector<int64_t> counts;
  const std::vector<int64_t>& frames = track->frames;
  for (size_t i = 0; i < frames.size(); ++i) {
    const bool goes_on = i + 1 < frames.size() && BeatsToNext(frames, i) == 1;
    for (int64_t part = 0; part < (goes_on ? n : 1); ++part) {
      const int64_t later = part > 0 ? part * (frames[i + 1] - frames[i]) / n : 0;
      more.frames.push_back(frames[i] + later);
      more.confidence.push_back(track->confidence[i]);
      counts.push_back(n * since[i] + part);
    }
  }
  Count(counts, &more);
  *track = std::move(more);
}

/// Whether nearly all beats of `track` are every `step`-th one of `others`, and nearly as many.
bool AreEvery(int64_t step, std::span<const int64_t> others, std::span<const int64_t> track) {
  double follow = 0;
  int64_t before = -1;  // the place in `others` of the beat before
  for (const int64_t frame : track) {
    const auto after = std::ranges::lower_bound(others, frame + kNearFrames + 1);
    const int64_t place = after - others.begin() - 1;
    const bool is_one = place >= 0 && frame - others[static_cast<size_t>(place)] <= kNearFrames;
    follow += is_one && before >= 0 && place == before + step;
    before = is_one ? place : -1;
  }
  return follow >= kNearlyAllBeats * static_cast<double>(std::ssize(others) / step - 1);
}

TempoLimits LimitsAround(double bpm) {
  const TempoLimits limits;
  return {std::max(limits.slowest_bpm, bpm / kTempoSlack),
          std::min(limits.fastest_bpm, bpm * kTempoSlack)};
}

}  // namespace

BeatTrack TrackNear(const BeatHint& hint, std::span<const Onset> onsets,
                    std::span<const float> mono, std::optional<int64_t> kept) {
  BeatTrack heard = TrackBeats(onsets, {}, MusicExtent::kWhole, mono);
  if (!hint.tempo_bpm) return heard;
  const double bpm = *hint.tempo_bpm;
  BeatTrack near = TrackBeats(onsets, LimitsAround(bpm), MusicExtent::kWhole, mono);
  if (heard.frames.empty()) return near;
  for (const int n : {2, 3}) {
    if (IsSameTempo(heard.tempo_bpm, n * bpm)) {
      if (AreEvery(n, heard.frames, near.frames)) return near;
      Divide(n, kept, &heard);
    } else if (IsSameTempo(n * heard.tempo_bpm, bpm)) {
      Multiply(n, &heard);
      if (AreEvery(1, heard.frames, near.frames)) return near;
    } else {
      continue;
    }
    heard.tempo_bpm = TempoOf(heard.Seconds());
    return heard;
  }
  return near;
}

void Follow(const BeatHint& hint, BeatTrack* track, std::optional<int64_t> kept) {
  if (track->frames.empty()) return;
  if (hint.half_time) Divide(2, kept, track);
  if (hint.double_time) Multiply(2, track);
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
