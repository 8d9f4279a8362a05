#pragma once

#include "model/fit/sources/position_clip.h"

namespace choreo {

/// The beats to which a motion was danced. Beat k >= 0 is at offset_s + k * period_s; beat 0 begins
/// a bar.
struct BeatGrid {
  double period_s = 0.5;
  double offset_s = 0;
  int per_bar = 4;
};

/// The same beats for a clip that begins `skipped_s` later. Beat 0 is the first beat there that
/// begins a bar.
BeatGrid Skip(BeatGrid grid, double skipped_s);

/// The share of the joints' mean speed's power that is at this period, 0 to 1. Throws
/// Error(kInvalidArgument) for a clip with fewer than three frames.
double SpeedPowerAt(const PositionClip& clip, double period_s);

}  // namespace choreo
