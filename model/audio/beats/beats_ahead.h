#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/audio/beats/beats.h"
#include "model/audio/beats/onset.h"

namespace choreo {

/// The beats of music that continues.
struct HeardBeats {
  BeatTrack track;
  /// How well predictions from earlier beats match onsets, relative to the beats found. About 1 in
  /// music; mostly less than 0.7 in speech or noise, whose best beats are meaningless.
  double foresight = 0;

  bool Certain() const;
};

/// Finds the beats of a stretch of music (TrackBeats). `first`: the frame of the first onset, to
/// which the result's frames refer. Pure.
HeardBeats HearBeats(std::span<const Onset> onsets, int64_t first);

/// Future beats, and the ones among them that begin a bar; seconds, ascending.
struct BeatsAhead {
  std::vector<double> beats = {}, downbeats = {};
  std::optional<double> confidence =
      {};  ///< of the beats that predict them, 0 to 1; none: they are known

  /// Keeps only beats in [from, to].
  void Keep(double from, double to);
};

/// Continues beats at their latest tempo from `now` until `until`, seconds. None if there are too
/// few beats to be sure of the tempo, or none in the last seconds.
BeatsAhead PredictBeats(const BeatTrack& track, double now, double until);

}  // namespace choreo
