#pragma once

#include "model/motion/motion.h"

namespace choreo {

inline constexpr double kOnFrame =
    1e-6;  ///< in frames: times this close to a frame count as that frame

/// The time from the first frame to the last, seconds.
double Duration(const Motion& motion);

/// The first frame at or after this time.
int64_t FirstFrameFrom(double seconds, double fps);

/// Interpolates between a (t = 0) and b (t = 1); extrapolates outside. The root moves along a line,
/// each joint along the shortest arc, on the branch nearest to a's.
Pose InterpolatePoses(const Pose& a, const Pose& b, double t);

/// The pose at `time` seconds after the first frame; outside the motion, the nearest end pose.
/// Throws Error(kInvalidArgument) for a motion without frames.
Pose PoseAt(const Motion& motion, double time);

/// Resamples a motion to `fps`, from 1e-3 to 1e4: frame i is PoseAt(i / fps), for as many frames as
/// fit into the duration. Branches stay continuous. A frame at a source frame's time equals it up
/// to whole turns. Throws Error(kInvalidArgument) for a rate outside the limits.
Motion Resample(const Motion& motion, double fps);

/// Undoes a file's rounding of its rate. Returns the whole number, or whole number x 1000/1001,
/// within 2 in 10,000 of the rate, or else the rate itself.
double WholeRate(double rate);

}  // namespace choreo
