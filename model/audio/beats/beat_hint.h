#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "model/audio/beats/beats.h"

namespace choreo {

/// A user's hint about a song's beats.
struct BeatHint {
  std::optional<double> tempo_bpm = {};  ///< beats are searched within 6 % of it (TrackNear)
  bool half_time = false, double_time = false;

  bool operator==(const BeatHint&) const = default;
};

/// The range of tempi in hints, beats per minute.
inline constexpr double kSlowestHint = 50, kFastestHint = 200;
inline constexpr int kDefaultBar = 4;  ///< beats in a bar if unknown

/// Finds the beats of a whole song (TrackBeats) near the hint's tempo, if it has one. Where that is
/// a half or a third of the tempo heard without a hint, or two or three times it, the search near
/// it may fall between the beats that are heard: then these are divided or multiplied as by Follow.
/// `mono` as in TrackBeats, `kept` as in Follow. Pure.
BeatTrack TrackNear(const BeatHint& hint, std::span<const Onset> onsets,
                    std::span<const float> mono = {}, std::optional<int64_t> kept = {});

/// Removes or adds every second beat according to the hint. Half time keeps every second beat,
/// counted from the beat nearest to frame `kept` or, without it, from the first downbeat of each
/// part between pauses. Bars keep their number of beats. A gap longer than 1.6 times the gaps
/// around it is a pause and gets no beat.
void Follow(const BeatHint& hint, BeatTrack* track, std::optional<int64_t> kept = {});

/// Recounts all beats so that `beat` has count `count` (0: the first). Beyond a pause, known counts
/// shift by as much as before it, because only music shows how many beats a pause lasts. Beats
/// without a count are counted by time.
void CountFrom(int64_t beat, int64_t count, BeatTrack* track);

/// Sets the counts of beats whose count is below 0 by counting on, in each part between pauses,
/// from its first downbeat or count.
void CountOn(BeatTrack* track);

/// The beat nearest to a frame. There must be a beat.
int64_t NearestBeat(const BeatTrack& track, int64_t frame);

}  // namespace choreo
