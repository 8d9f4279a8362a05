#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Inverse kinematics of the whole body: targets pull some joints, and the others follow.
namespace choreo {

/// The position that a joint should reach, in the world, metres.
struct JointTarget {
  int joint = -1;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

struct DrawnPose {
  Pose pose;
  std::vector<double> missed_m;  ///< [targets] each joint's final distance from its target
};

/// What hands, head and chest do without targets when the pelvis has a target.
enum class UpperBody {
  kStays,  ///< they stay nearly in place, as with hands on a barre
  kFollowsPelvis,
};

/// Pulls joints to their targets by a least-squares fit (fit/solver/fit_problem.h). Feet without
/// targets stay in place. Hands, head, pelvis and chest stay nearby, so an arm reaches first, and
/// the trunk leans only if the arm is too short. Knees and elbows bend freely; other joints turn as
/// little as needed. Meets targets within reach to a millimetre or two, and approaches others.
/// Takes about a millisecond. `targets` are finite, one per joint at most. Pure. Throws
/// Error(kInvalidArgument) for a pose of another joint count.
DrawnPose DrawJoints(const Skeleton& skeleton, const Pose& pose,
                     std::span<const JointTarget> targets,
                     UpperBody upper_body = UpperBody::kStays);

}  // namespace choreo
