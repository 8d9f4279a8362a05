#include "model/motion/kinematics/kinematics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// `local(joint)` returns the joint's local rotation matrix.
template <typename Local>
void Place(const Skeleton& skeleton, const Eigen::Vector3d& root, const Local& local,
           JointPlacement& placement) {
  const int joints = skeleton.joints();
  placement.positions.resize(3, joints);
  placement.rotations.resize(joints);
  placement.positions.col(0) = root;
  placement.rotations[0] = local(0);
  for (int joint = 1; joint < joints; ++joint) {
    const int parent = skeleton.parents[joint];
    const Eigen::Matrix3d& frame = placement.rotations[parent];
    placement.positions.col(joint) =
        placement.positions.col(parent) + frame * skeleton.offsets.col(joint);
    placement.rotations[joint].noalias() = frame * local(joint);
  }
}

}  // namespace

void ForwardKinematics(const Skeleton& skeleton, const Pose& pose, JointPlacement& placement) {
  const int joints = skeleton.joints();
  if (pose.rotations.cols() != joints) {
    throw InvalidArgument("pose.rotations", std::to_string(pose.rotations.cols()) +
                                                " joints, the skeleton '" + skeleton.name +
                                                "' has " + std::to_string(joints));
  }
  Place(
      skeleton, pose.root_position, [&](int j) { return ExpMap(pose.rotations.col(j)); },
      placement);
}

void ForwardKinematics(const Skeleton& skeleton, const Eigen::Vector3d& root,
                       const Eigen::Ref<const Eigen::Matrix3Xd>& local, JointPlacement& placement) {
  Place(
      skeleton, root, [&](int j) { return local.middleCols<3>(3 * j); }, placement);
}

JointPlacement ForwardKinematics(const Skeleton& skeleton, const Pose& pose) {
  JointPlacement placement;
  ForwardKinematics(skeleton, pose, placement);
  return placement;
}

Eigen::Matrix3Xd JointPositions(const Skeleton& skeleton, const Pose& pose) {
  thread_local JointPlacement placement;  // keeps its memory
  ForwardKinematics(skeleton, pose, placement);
  return placement.positions;
}

namespace {

void CheckMask(const Skeleton& skeleton, const PoseMask& mask) {
  if (mask.joints.empty() || static_cast<int>(mask.joints.size()) == skeleton.joints()) return;
  throw InvalidArgument("mask.joints", std::to_string(mask.joints.size()) +
                                           " joints, must be 0 or " +
                                           std::to_string(skeleton.joints()));
}

}  // namespace

PoseError ComparePoses(const Skeleton& skeleton, const Pose& a, const Pose& b,
                       const PoseMask& mask) {
  CheckMask(skeleton, mask);
  const int joints = skeleton.joints();
  Eigen::Matrix3Xd difference = JointPositions(skeleton, a) - JointPositions(skeleton, b);
  PoseError error;
  const bool every_joint =
      std::find(mask.joints.begin(), mask.joints.end(), false) == mask.joints.end();
  if (every_joint) {
    if (!mask.root_position) difference.colwise() -= difference.col(0).eval();
    error.position_m = difference.colwise().norm().maxCoeff();
  } else if (mask.root_position) {
    error.position_m = difference.col(0).norm();
  }
  for (int joint = 0; joint < joints; ++joint) {
    if (!mask.Constrains(joint)) continue;
    const double angle = RotationDifference(a.rotations.col(joint), b.rotations.col(joint)).norm();
    error.angle_deg = std::max(error.angle_deg, angle * kDegrees);
  }
  return error;
}

std::vector<bool> KnownPlaces(const Skeleton& skeleton, const PoseMask& mask) {
  std::vector<bool> known(static_cast<size_t>(skeleton.joints()), true);
  for (size_t joint = 1; joint < known.size(); ++joint) {
    const int parent = skeleton.parents[joint];
    known[joint] = known[static_cast<size_t>(parent)] && mask.Constrains(parent);
  }
  return known;
}

std::optional<double> StandingHeight(const Skeleton& skeleton, const Pose& pose,
                                     const PoseMask& mask) {
  CheckMask(skeleton, mask);
  const std::vector<bool> known = KnownPlaces(skeleton, mask);
  const Eigen::RowVectorXd rest = JointPositions(skeleton, RestPose(skeleton)).row(1);
  Eigen::RowVectorXd least = Eigen::RowVectorXd::Constant(rest.cols(), rest.minCoeff());
  for (const int foot : skeleton.feet) {
    if (foot < 0 || !known[static_cast<size_t>(foot)]) return std::nullopt;
    least[foot] = rest[foot];
  }
  const Eigen::RowVectorXd hanging =
      JointPositions(skeleton, {Eigen::Vector3d::Zero(), pose.rotations}).row(1);
  double height = 0;
  for (Eigen::Index joint = 0; joint < rest.cols(); ++joint) {
    if (known[static_cast<size_t>(joint)]) height = std::max(height, least[joint] - hanging[joint]);
  }
  return height;
}

Pose RestPose(const Skeleton& skeleton) {
  Pose pose;
  pose.root_position.y() = skeleton.pelvis_height;
  pose.rotations = Eigen::Matrix3Xd::Zero(3, skeleton.joints());
  return pose;
}

Pose StandingPose(const Skeleton& skeleton) {
  constexpr double kFromBody = 0.3, kElbowBend = 0.3;  // radians
  Pose pose = RestPose(skeleton);
  for (const Hinge& hinge : Hinges(skeleton)) {
    const bool left = hinge.joint == skeleton.left_elbow;
    if (hinge.upper < 0 || (!left && hinge.joint != skeleton.right_elbow)) continue;
    const double side = left ? 1 : -1;
    const Eigen::Vector3d hanging(side * std::sin(kFromBody), -std::cos(kFromBody), 0);
    const Eigen::Vector3d arm = skeleton.offsets.col(hinge.joint);
    pose.rotations.col(hinge.upper) =
        LogMap(Eigen::Quaterniond::FromTwoVectors(arm, hanging).toRotationMatrix());
    pose.rotations.col(hinge.joint) = kElbowBend * hinge.axis;
  }
  return pose;
}

}  // namespace choreo
