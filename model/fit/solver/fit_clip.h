#pragma once

#include "model/fit/solver/position_fitter.h"
#include "model/fit/sources/position_clip.h"
#include "model/fit/sources/sources.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Fits rotations of our skeleton to recorded joint positions. First normalises the source's bones
/// (its directions, our lengths), then solves for each frame's rotations by damped least squares,
/// starting from the frame before.
namespace choreo {

struct FitResult {
  Motion motion;            ///< at the clip's fps
  double mean_error_m = 0;  ///< over frames and landmarks, against the bone-normalised source
  double p95_error_m = 0;
  double scale = 1;           ///< SourceSize::scale
  double ground_shift_m = 0;  ///< the mean correction of heights (Ground)
};

/// Puts the body on the floor at least every few seconds. The correction changes slowly, so jumps
/// stay. Returns its mean, metres.
double Ground(const Skeleton& skeleton, Motion& motion);

/// Fits a whole clip: measures and normalises it, fits forwards, refines once with both neighbours
/// known (zero phase), and grounds the result. About 0.5 ms per frame.
FitResult FitClip(const PositionClip& clip, const SourceMapping& mapping, const Skeleton& skeleton,
                  const FitOptions& options = {});

}  // namespace choreo
