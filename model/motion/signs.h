#pragma once

#include "model/motion/motion.h"

namespace choreo {

/// The same pose, each rotation written so that its quaternion (QuaternionFromExp) has the sign of
/// `previous`'s, their product not negative: of those vectors the nearest to `previous`. From frame
/// to frame quaternions then never jump. The vectors are those of MakeContinuous, but around whole
/// turns about an axis that tilts, where no choice of vectors is continuous in time. Pure,
/// thread-safe.
Pose KeepSigns(Pose pose, const Pose& previous);

}  // namespace choreo
