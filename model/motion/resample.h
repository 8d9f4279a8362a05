#pragma once

#include "model/motion/motion.h"

namespace choreo {

inline constexpr double kOnFrame = 1e-6;  ///< frames: times this close to a frame are that frame

/// Seconds from the first frame to the last.
double Duration(const Motion& motion);

/// The first frame at or after this second.
int64_t FirstFrameFrom(double seconds, double fps);

/// The pose at `t` between a (0) and b (1); extrapolates outside. The root moves along the line,
/// joints along the shortest arc on the branches nearest to a's.
Pose InterpolatePoses(const Pose& a, const Pose& b, double t);

/// The pose at `time` seconds after the first frame; outside the motion, the nearest end pose.
/// Throws Error(kInvalidArgument) for a motion without frames.
Pose PoseAt(const Motion& motion, double time);

/// Resamples a motion to 1e-3 to 1e4 fps: frame i is PoseAt(i / fps), as many as fit into the
/// duration. Branches stay continuous; frames that fall on source frames equal them up to whole
/// turns. Throws Error(kInvalidArgument) for a rate outside the limits.
Motion Resample(const Motion& motion, double fps);

/// Undoes a file's rounding of its rate: the whole number, or whole number x 1000/1001, within 2 in
/// 10 000; else the rate itself.
double WholeRate(double rate);

}  // namespace choreo
