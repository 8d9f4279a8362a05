#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "model/audio/beats/beats.h"

namespace choreo {

/// A user's hint about a song's beats.
struct BeatHint {
  std::optional<double> tempo_bpm = {};  ///< beats are searched within 6 % of it
  bool half_time = false, double_time = false;

  bool operator==(const BeatHint&) const = default;
};

/// The range of tempi in hints, beats per minute.
inline constexpr double kSlowestHint = 50, kFastestHint = 200;
inline constexpr int kDefaultBar = 4;  ///< beats in a bar if unknown

/// The range of tempi near the hint's.
TempoLimits LimitsOf(const BeatHint& hint);

/// Removes or adds every second beat according to the hint. Half time keeps the beats with the one
/// nearest to frame `kept` or, without it, with the first downbeat of each part between pauses.
/// Bars keep their number of beats. A gap longer than 1.6 times the gaps around it is a pause and
/// gets no beat.
void Follow(const BeatHint& hint, BeatTrack* track, std::optional<int64_t> kept = {});

/// Sets the counts of all beats from that of one beat, which is `count`, from 0 on. Beyond a pause,
/// counts move by as much as before it, because only music shows how many beats a pause lasts;
/// beats without a count are counted by time.
void CountFrom(int64_t beat, int64_t count, BeatTrack* track);

/// Sets the counts of beats whose count is below 0 by counting on, in each part between pauses,
/// from its first downbeat or count.
void CountOn(BeatTrack* track);

/// The beat nearest to a frame. There must be a beat.
int64_t NearestBeat(const BeatTrack& track, int64_t frame);

}  // namespace choreo
