#pragma once

#include <span>
#include <vector>

#include "model/metrics/joint_track.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Measures how a dance varies: its turns, bends, rests and changes of pace. Pure functions,
/// thread-safe.
namespace choreo {

inline constexpr double kContrastSeconds = 2;  ///< of a window

/// Turn of the root's heading in each window of 2 s, radians, positive to the left. Windows adjoin,
/// sharing end poses, from the first pose on. Whole turns count.
std::vector<double> WindowTurns(std::span<const Pose> poses, double fps);

/// Share of the poses whose root faces more than a right angle away from `front`, radians about +Y.
/// 0 for no poses.
double FacesAway(std::span<const Pose> poses, double front);

/// A hand slower than this relative to the root is at rest, m/s: hands of real, unseen dancers of
/// dancedb are in 6.3 % of frames.
inline constexpr double kRestSpeed = 0.16;
/// Share of (wrist, step) pairs in which the wrist (the elbow's first child) is at rest. 0 for
/// fewer than two frames. Throws Error(kInvalidArgument) for a skeleton without elbows or wrists.
double HandsAtRest(const Skeleton& skeleton, double fps, const JointTrack& track);

/// The angle between the vertical and the line from the pelvis to between the shoulders, degrees,
/// by pose. Throws Error(kInvalidArgument) for a skeleton without shoulders.
std::vector<double> TrunkLean(const Skeleton& skeleton, const JointTrack& track);

/// How much liveliness varies: the standard deviation over adjoining windows of 2 s of the
/// logarithm of their mean joint speed. NaN for fewer than two windows.
double PaceSpread(double fps, const JointTrack& track);

}  // namespace choreo
