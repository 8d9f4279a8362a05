#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "model/audio/beats.h"

namespace choreo {

/// A hint about the beats from somebody who knows the music.
struct BeatHint {
  std::optional<double> tempo_bpm = {};  ///< beats are looked for within 6 % of it
  bool half_time = false, double_time = false;

  bool operator==(const BeatHint&) const = default;
};

/// Tempi that a hint may name, beats a minute.
inline constexpr double kSlowestHint = 50, kFastestHint = 200;
inline constexpr int kDefaultBar = 4;  ///< beats, where nobody says how many

/// Tempi near that of the hint.
TempoLimits LimitsOf(const BeatHint& hint);

/// Drops or adds every second beat, as the hint says. Half time keeps the half that contains the
/// beat nearest to frame `kept`; none: the first downbeat of each part between pauses. Bars keep
/// their number of beats. A gap longer than 1.6 beats, by the gaps around, is a pause, and gets no
/// beat.
void Follow(const BeatHint& hint, BeatTrack* track, std::optional<int64_t> kept = {});

/// Counts forwards and backwards from a beat, whose count from 0 on is `count`. Beyond a pause the
/// count moves by as much: only music says how many beats of a bar a pause takes. By time, if it
/// had no count.
void CountFrom(int64_t beat, int64_t count, BeatTrack* track);

/// Continues the count, in each part between pauses from its first downbeat or count, to beats
/// whose count is below 0.
void CountOn(BeatTrack* track);

/// The beat nearest to a frame; there must be one.
int64_t NearestBeat(const BeatTrack& track, int64_t frame);

}  // namespace choreo
