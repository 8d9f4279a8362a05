#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Inverse kinematics of the whole body: joints are drawn to places, the rest follows.
namespace choreo {

/// Where a joint should be: world, metres.
struct JointTarget {
  int joint = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

struct DrawnPose {
  Pose pose;
  std::vector<double> missed_m;  ///< [targets] how far off each joint ended
};

/// Draws joints to their targets. Feet that are no targets stay where they are; hands, head, pelvis
/// and chest stay about there, so that an arm reaches first and the trunk leans where the arm is
/// too short. Knees and elbows bend as they can, the other joints turn as little as need be. A
/// least squares fit (fit/fit_problem.h): a target within reach is met to a millimetre or two,
/// another one is neared. About a millisecond. `targets` are finite, of different joints of the
/// skeleton. Pure; throws Error(kInvalidArgument) for a pose of another joint count.
DrawnPose DrawJoints(const Skeleton& skeleton, const Pose& pose,
                     std::span<const JointTarget> targets);

}  // namespace choreo
