#pragma once

#include "model/fit/position_clip.h"
#include "model/fit/position_fitter.h"
#include "model/fit/sources.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Joint positions → rotations of our skeleton, in two steps: bone-normalise the source (its
/// directions, our lengths), then solve each frame's rotations by damped least squares, starting
/// from the frame before.
namespace choreo {

struct FitResult {
  Motion motion;            ///< at the clip's fps
  double mean_error_m = 0;  ///< over frames and landmarks, against the bone-normalised source
  double p95_error_m = 0;
  double scale = 1;           ///< SourceSize::scale
  double ground_shift_m = 0;  ///< mean of what was added to the heights
};

/// Brings the body down to the floor at least every few seconds. The correction changes slowly, so
/// that jumps stay. Returns its mean, metres.
double Ground(const Skeleton& skeleton, Motion& motion);

/// Fits a whole clip: measure, normalise, fit forwards, refine once with both neighbours known
/// (zero phase), and ground. About 0.5 ms a frame.
FitResult FitClip(const PositionClip& clip, const SourceMapping& mapping, const Skeleton& skeleton,
                  const FitOptions& options = {});

}  // namespace choreo
