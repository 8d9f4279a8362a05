#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Inverse kinematics of the whole body: targets pull some joints, and the rest follow.
namespace choreo {

/// Where a joint should be: world, metres.
struct JointTarget {
  int joint = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

struct DrawnPose {
  Pose pose;
  std::vector<double> missed_m;  ///< [targets] final distance of each joint
};

/// Draws joints to their targets. Other feet stay in place; hands, head, pelvis and chest stay
/// nearby, so that an arm reaches first and the trunk leans if the arm is too short. Knees and
/// elbows bend freely; other joints turn as little as needed. A least-squares fit
/// (fit/fit_problem.h) meets targets within reach to a millimetre or two and approaches others.
/// About a millisecond. `targets` are finite and for different joints of the skeleton. Pure; throws
/// Error(kInvalidArgument) for a pose of another joint count.
DrawnPose DrawJoints(const Skeleton& skeleton, const Pose& pose,
                     std::span<const JointTarget> targets);

}  // namespace choreo
