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

/// Forward kinematics into `placement`, without allocation if it already has the skeleton's size.
void ForwardKinematics(const Skeleton& skeleton, const Pose& pose, JointPlacement& placement);
/// Forward kinematics from a root position, metres, and the joints' local rotation matrices side by
/// side, [3, 3 * joints].
void ForwardKinematics(const Skeleton& skeleton, const Eigen::Vector3d& root,
                       const Eigen::Ref<const Eigen::Matrix3Xd>& local, JointPlacement& placement);

/// The distance between two poses: the largest joint distance (metres) and the largest angle of a
/// local joint rotation (degrees). Degrees of freedom outside `mask` do not count. Without the root
/// position, both roots are moved to one place. If any joint is masked out, the distance is the
/// root's alone (0 if that is masked out, too), and the angle is over the remaining joints.
struct PoseError {
  double position_m = 0;
  double angle_deg = 0;
};
PoseError ComparePoses(const Skeleton& skeleton, const Pose& a, const Pose& b,
                       const PoseMask& mask = {});

/// Whether `mask` determines each joint's position relative to the root, [joints]: it includes the
/// rotations of all joints above.
std::vector<bool> KnownPlaces(const Skeleton& skeleton, const PoseMask& mask);

/// The root height, metres, at which the pose stands on the floor: no joint is lower than the
/// lowest joint at rest, and no foot joint is lower than itself at rest. None for skeletons without
/// feet, and if `mask` does not determine the feet's position relative to the root.
std::optional<double> StandingHeight(const Skeleton& skeleton, const Pose& pose,
                                     const PoseMask& mask = {});

/// The pose without rotations: feet on the floor, at the origin, facing +Z.
Pose RestPose(const Skeleton& skeleton);

/// The pose in which a dance without history starts: standing at ease, arms hanging. The rest pose
/// for skeletons without elbows.
Pose StandingPose(const Skeleton& skeleton);

}  // namespace choreo
