#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// World placement of every joint of one pose.
struct JointPlacement {
  Eigen::Matrix3Xd positions;              ///< [3, joints] metres
  std::vector<Eigen::Matrix3d> rotations;  ///< [joints] global rotations
};

/// Forward kinematics. Throws Error(kInvalidArgument) if the pose's joint count is not the
/// skeleton's.
JointPlacement ForwardKinematics(const Skeleton& skeleton, const Pose& pose);

/// Positions alone, [3, joints].
Eigen::Matrix3Xd JointPositions(const Skeleton& skeleton, const Pose& pose);

/// The same without allocation if `placement` already has the skeleton's size.
void ForwardKinematics(const Skeleton& skeleton, const Pose& pose, JointPlacement& placement);
/// The same from local rotation matrices, [3, 3 joints], one after another.
void ForwardKinematics(const Skeleton& skeleton, const Eigen::Vector3d& root,
                       const Eigen::Ref<const Eigen::Matrix3Xd>& local, JointPlacement& placement);

/// The distance between two poses: the largest joint distance (metres) and the largest angle of a
/// local joint rotation (degrees). Ignores degrees of freedom outside `mask`: without the root's
/// position it measures with both roots in one place; with any joint masked out the distance is the
/// root's alone (0 if that is masked too) and the angles those of the other joints.
struct PoseError {
  double position_m = 0;
  double angle_deg = 0;
};
PoseError ComparePoses(const Skeleton& skeleton, const Pose& a, const Pose& b,
                       const PoseMask& mask = {});

/// [joints] Whether `mask` determines where a joint is relative to the root: it includes the
/// rotations of all joints above.
std::vector<bool> KnownPlaces(const Skeleton& skeleton, const PoseMask& mask);

/// The root height at which the pose stands on the floor: no joint lower than the lowest at rest,
/// no foot joint lower than itself at rest. None if `mask` leaves open how the feet hang below the
/// root, and without feet.
std::optional<double> StandingHeight(const Skeleton& skeleton, const Pose& pose,
                                     const PoseMask& mask = {});

/// The skeleton without rotations, feet on the floor, at the origin, facing +Z.
Pose RestPose(const Skeleton& skeleton);

/// The pose in which a dance without history starts: standing at ease, with hanging arms. Without
/// elbows it is the rest pose.
Pose StandingPose(const Skeleton& skeleton);

}  // namespace choreo
