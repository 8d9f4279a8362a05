#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/audio/beats.h"
#include "model/audio/onset.h"

namespace choreo {

/// The beats of music that goes on.
struct HeardBeats {
  BeatTrack track;
  /// How well predictions from its earlier beats met onsets, relative to the beats found: about 1
  /// in music; in speech or noise, whose best beats mean nothing, mostly less than 0.7.
  double foresight = 0;

  bool Certain() const;
};

/// Finds the beats of a stretch of music (TrackBeats). `first`: the frame of the first onset, which
/// counts for the result's frames. Pure.
HeardBeats HearBeats(std::span<const Onset> onsets, int64_t first);

/// Beats to come, seconds, ascending, and those of them that begin a bar.
struct BeatsAhead {
  std::vector<double> beats = {}, downbeats = {};
  std::optional<double> confidence = {};  ///< of the beats that predict them, 0 to 1; none: known

  /// Keeps only those in [from, to].
  void Keep(double from, double to);
};

/// Continues beats at their latest tempo, from second `now` until `until`. None if they are too few
/// to be sure of the tempo, or none of them is in the last seconds.
BeatsAhead PredictBeats(const BeatTrack& track, double now, double until);

}  // namespace choreo
