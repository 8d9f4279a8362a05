#pragma once

#include <span>
#include <vector>

#include "model/metrics/joint_track.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Measures the variety of a dance: turns, bends, rests and changes of pace. Pure functions,
/// thread-safe.
namespace choreo {

inline constexpr double kContrastSeconds = 2;  ///< length of a window

/// The turn of the root's heading in each window of 2 s, radians, positive to the left. Counts
/// whole turns. Windows adjoin from the first pose on and share their end poses.
std::vector<double> WindowTurns(std::span<const Pose> poses, double fps);

/// The share of poses whose root faces more than a right angle away from `front`, radians about +Y.
/// 0 for no poses.
double FacesAway(std::span<const Pose> poses, double front);

/// A hand slower than this relative to the root is at rest, m/s. Hands of dancedb's held-out
/// dancers are at rest in 6.3 % of frames.
inline constexpr double kRestSpeed = 0.16;
/// The share of (wrist, step) pairs with the wrist (the elbow's first child) at rest. 0 for fewer
/// than two frames. Throws Error(kInvalidArgument) for a skeleton without elbows or wrists.
double HandsAtRest(const Skeleton& skeleton, double fps, const JointTrack& track);

/// The angle between the vertical and the line from the pelvis to the middle of the shoulders,
/// degrees, by pose. Throws Error(kInvalidArgument) for a skeleton without shoulders.
std::vector<double> TrunkLean(const Skeleton& skeleton, const JointTrack& track);

/// The variation of pace: the standard deviation, over adjoining windows of 2 s, of the logarithm
/// of the mean joint speed. NaN for fewer than two windows.
double PaceSpread(double fps, const JointTrack& track);

}  // namespace choreo
