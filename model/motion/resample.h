#pragma once

#include "model/motion/motion.h"

namespace choreo {

inline constexpr double kOnFrame = 1e-6;  ///< frames: closer than this is the frame itself

/// Seconds from the first frame to the last.
double Duration(const Motion& motion);

/// The pose `t` (0 to 1, outside extrapolates) of the way from a to b: root along the line, joints
/// along the shortest arc, on the branches nearest to a's.
Pose InterpolatePoses(const Pose& a, const Pose& b, double t);

/// The pose at `time` seconds after the first frame; before it and after the last frame the end
/// poses hold. Throws Error(kInvalidArgument) for a motion without frames.
Pose PoseAt(const Motion& motion, double time);

/// The same motion at another rate (1e-3 to 1e4 fps): frame i is PoseAt(i / fps), as many as fit
/// into the duration. Branches stay continuous, and frames that fall on source frames are those, up
/// to whole turns. Throws Error(kInvalidArgument) for a rate outside the limits.
Motion Resample(const Motion& motion, double fps);

/// The whole number, or whole number x 1000/1001, that a rate read from a file is a rounding of (2
/// in 10 000); the rate itself where it is none.
double WholeRate(double rate);

}  // namespace choreo
