#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/core/quantile.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Joint positions in the world, frame by frame: [frames] of [3, joints], metres: all that most
/// metrics need.
using JointTrack = std::vector<Eigen::Matrix3Xd>;

/// Throws Error(kInvalidArgument) if there are no frames, or the two counts differ.
void CheckSameFrames(Eigen::Index danced, Eigen::Index other);

JointTrack TrackJoints(const Skeleton& skeleton, std::span<const Pose> poses);

/// Mean joint speed of each step (frame i to i + 1), m/s; one shorter than the track. Paper F's
/// "kinematic velocity curve" (4.5.1).
std::vector<float> MeanSpeeds(const JointTrack& track, double fps);

/// How fast and how jerky a dance is, over all joints and frames. Jerk, the third derivative of
/// position, has measured smoothness since Flash and Hogan (1985). Use medians: both have long
/// tails.
struct Pace {
  std::vector<float> speeds;  ///< m/s, of each joint and step
  std::vector<float> jerks;   ///< m/s^3, third difference of each joint and four frames

  void Add(const JointTrack& track, double fps);
  void Add(const Pace& other);
  double median_speed() const { return Percentile(speeds, 0.5); }
  double median_jerk() const { return Percentile(jerks, 0.5); }
};

}  // namespace choreo
