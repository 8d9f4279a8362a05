#pragma once

#include <Eigen/Core>

#include "model/motion/motion.h"

namespace choreo {

/// The root's velocity over the ground (paper F, Section 3.2.1), relative to the earlier pose's
/// heading.
struct RootVelocity {
  double forward = 0;   ///< m/s, towards the earlier heading
  double sideways = 0;  ///< m/s, positive to the dancer's left
  double yaw = 0;       ///< rad/s about +Y, of the heading; the shorter way round
};

RootVelocity RootVelocityBetween(const Pose& earlier, const Pose& later, double fps);

/// A joint's jerk, m/s^3: the norm of the third difference of its positions in four consecutive
/// frames.
double JointJerk(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                 const Eigen::Vector3d& third, const Eigen::Vector3d& fourth, double fps);

}  // namespace choreo
