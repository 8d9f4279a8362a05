#include "model/motion/floor/floor_clearance.h"

#include <algorithm>

#include "model/motion/floor/support.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

constexpr double kLimbDepth = 0.05;

}  // namespace

Eigen::RowVectorXd FloorClearance(const Skeleton& skeleton) {
  const Eigen::RowVectorXd rest = JointPositions(skeleton, RestPose(skeleton)).row(1);
  Eigen::RowVectorXd depth = Eigen::RowVectorXd::Constant(rest.size(), kLimbDepth);
  const auto parent = [&](int joint) { return skeleton.parents[static_cast<size_t>(joint)]; };
  // The trunk: hips, and all joints above them and above the shoulders.
  for (const int hip : {skeleton.left_hip, skeleton.right_hip})
    for (int joint = hip; joint >= 0; joint = parent(joint)) depth[joint] = kTrunkDepth;
  for (const int shoulder : {skeleton.left_shoulder, skeleton.right_shoulder}) {
    for (int joint = shoulder < 0 ? -1 : parent(shoulder); joint >= 0; joint = parent(joint))
      depth[joint] = kTrunkDepth;
  }
  // Some skeletons have foot joints beyond the roles, such as heels.
  Eigen::RowVectorXd clearance = rest.cwiseMin(depth);
  for (const int foot : skeleton.feet) {
    if (foot >= 0) clearance[foot] = rest[foot];
  }
  return clearance;
}

double HeightAboveFloor(const Skeleton& skeleton, const Pose& pose) {
  return (JointPositions(skeleton, pose).row(1) - FloorClearance(skeleton)).minCoeff();
}

std::vector<int> JointsOnFloor(const Skeleton& skeleton, const Eigen::RowVectorXd& clearance,
                               const Eigen::Matrix3Xd& joints) {
  std::vector<int> on_floor;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const bool is_foot = std::ranges::any_of(skeleton.feet, [&](int foot) {
      return foot >= 0 && IsBelow(joint, foot, skeleton.parents);  // also a heel
    });
    if (!is_foot && joints(1, joint) < clearance[joint] + kSoleHeight) on_floor.push_back(joint);
  }
  return on_floor;
}

bool RestsOnFloor(const Skeleton& skeleton, const Pose& pose) {
  return !JointsOnFloor(skeleton, FloorClearance(skeleton), JointPositions(skeleton, pose)).empty();
}

}  // namespace choreo
