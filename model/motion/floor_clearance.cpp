#include "model/motion/floor_clearance.h"

#include <algorithm>

#include "model/motion/kinematics.h"
#include "model/motion/support.h"

namespace choreo {
namespace {

constexpr double kLimbDepth = 0.05;

}  // namespace

Eigen::RowVectorXd FloorClearance(const Skeleton& skeleton) {
  const Eigen::RowVectorXd rest = JointPositions(skeleton, RestPose(skeleton)).row(1);
  Eigen::RowVectorXd depth = Eigen::RowVectorXd::Constant(rest.size(), kLimbDepth);
  for (int limb :
       {skeleton.left_hip, skeleton.right_hip, skeleton.left_shoulder, skeleton.right_shoulder}) {
    const bool hip = limb == skeleton.left_hip || limb == skeleton.right_hip;
    int joint = hip || limb < 0 ? limb : skeleton.parents[static_cast<size_t>(limb)];
    for (; joint >= 0; joint = skeleton.parents[static_cast<size_t>(joint)])
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
    const bool foot = std::ranges::find(skeleton.feet, joint) != skeleton.feet.end();
    if (!foot && joints(1, joint) < clearance[joint] + kSoleHeight) on_floor.push_back(joint);
  }
  return on_floor;
}

bool RestsOnFloor(const Skeleton& skeleton, const Pose& pose) {
  return !JointsOnFloor(skeleton, FloorClearance(skeleton), JointPositions(skeleton, pose)).empty();
}

}  // namespace choreo
