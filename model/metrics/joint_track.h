#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/core/numbers/quantile.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Joint positions in the world: [frames] of [3, joints], metres. The input of most metrics.
using JointTrack = std::vector<Eigen::Matrix3Xd>;

/// Throws Error(kInvalidArgument) if there are no frames, or the two counts differ.
void CheckSameFrames(Eigen::Index danced, Eigen::Index other);

JointTrack TrackJoints(const Skeleton& skeleton, std::span<const Pose> poses);

/// The mean joint speed of each step (frame i to i + 1), m/s: paper F's "kinematic velocity curve"
/// (4.5.1). One shorter than the track.
std::vector<float> MeanSpeeds(const JointTrack& track, double fps);

/// The speeds and jerks of a dance, over all joints and frames. Jerk, the third derivative of
/// position, has measured smoothness since Flash and Hogan (1985). Both have long tails, so use
/// medians.
struct Pace {
  std::vector<float> speeds;  ///< m/s, of each joint and step
  std::vector<float> jerks;   ///< m/s^3, of each joint and four consecutive frames

  void Add(const JointTrack& track, double fps);
  void Add(const Pace& other);
  double median_speed() const { return Percentile(speeds, 0.5); }
  double median_jerk() const { return Percentile(jerks, 0.5); }
};

}  // namespace choreo
