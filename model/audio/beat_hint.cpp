#include "model/audio/beat_hint.h"

#include <algorithm>
#include <cstdlib>

namespace choreo {
namespace {

constexpr double kTempoSlack = 1.06;  // either way: a semitone

int64_t FirstDownbeat(const BeatTrack& track) {
  const auto first = std::ranges::find(track.in_bar, 0);
  return first == track.in_bar.end() ? 0 : first - track.in_bar.begin();
}

void Halve(int64_t first, BeatTrack* track) {
  BeatTrack half{.beats_in_bar = track->beats_in_bar};
  for (auto i = static_cast<size_t>(first % 2); i < track->frames.size(); i += 2) {
    half.frames.push_back(track->frames[i]);
    half.confidence.push_back(track->confidence[i]);
  }
  CountFrom(first / 2, &half);
  *track = std::move(half);
}

void Double(BeatTrack* track) {
  BeatTrack twice{.beats_in_bar = track->beats_in_bar};
  for (size_t i = 0; i < track->frames.size(); ++i) {
    twice.frames.push_back(track->frames[i]);
    twice.confidence.push_back(track->confidence[i]);
    if (i + 1 == track->frames.size()) break;
    twice.frames.push_back((track->frames[i] + track->frames[i + 1]) / 2);
    twice.confidence.push_back(track->confidence[i]);
  }
  CountFrom(2 * FirstDownbeat(*track), &twice);
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
  if (hint.half_time) Halve(kept ? NearestBeat(*track, *kept) : FirstDownbeat(*track), track);
  if (hint.double_time) Double(track);
}

void CountFrom(int64_t first, BeatTrack* track) {
  const int bar = track->beats_in_bar > 0 ? track->beats_in_bar : kDefaultBar;
  track->beats_in_bar = bar;
  track->in_bar.resize(track->frames.size());
  for (size_t i = 0; i < track->frames.size(); ++i) {
    const int64_t since = static_cast<int64_t>(i) - first;
    track->in_bar[i] = static_cast<int>((since % bar + bar) % bar);
  }
}

int64_t NearestBeat(const BeatTrack& track, int64_t frame) {
  const auto nearest = std::ranges::min_element(
      track.frames, {}, [frame](int64_t beat) { return std::abs(beat - frame); });
  return nearest - track.frames.begin();
}

}  // namespace choreo
