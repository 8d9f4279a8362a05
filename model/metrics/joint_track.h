#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Joint positions in the world, frame by frame: [frames] of [3, joints], metres. Most metrics need
/// no more.
using JointTrack = std::vector<Eigen::Matrix3Xd>;

JointTrack TrackJoints(const Skeleton& skeleton, std::span<const Pose> poses);

/// Mean joint speed of each step (frame i to i + 1), m/s: one shorter than the track. Paper F's
/// "kinematic velocity curve" (4.5.1).
std::vector<float> MeanSpeeds(const JointTrack& track, double fps);

}  // namespace choreo
