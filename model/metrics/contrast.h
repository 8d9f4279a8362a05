#pragma once

#include <span>
#include <vector>

#include "model/metrics/joint_track.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// What a dance does by turns: it turns, comes to rest, goes on. Pure functions, thread-safe.
namespace choreo {

inline constexpr double kContrastSeconds = 2;  ///< of a window

/// How far the root's heading turns in each window of 2 s, radians, to the left positive: windows
/// stand side by side from the first pose on, and share their ends. Whole turns count.
std::vector<double> WindowTurns(std::span<const Pose> poses, double fps);

/// A hand that is slower is at rest, m/s as seen from the root: that of the real dancers of dancedb
/// whom no model has seen is, in 6.3 % of frames.
inline constexpr double kRestSpeed = 0.16;
/// Share of (wrist, step) pairs in which the wrist, the elbow's first child, is at rest. 0 for
/// fewer than two frames. Throws Error(kInvalidArgument) for a skeleton without elbows or wrists.
double HandsAtRest(const Skeleton& skeleton, double fps, const JointTrack& track);

/// How much livelier one moment is than another: the standard deviation over windows of 2 s, side
/// by side, of the logarithm of their mean joint speed. NaN for fewer than two windows.
double PaceSpread(double fps, const JointTrack& track);

}  // namespace choreo
