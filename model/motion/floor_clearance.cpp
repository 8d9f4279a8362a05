#include "model/motion/floor_clearance.h"

#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr double kBodyClearance = 0.05;

}  // namespace

Eigen::RowVectorXd FloorClearance(const Skeleton& skeleton) {
  const Eigen::RowVectorXd rest = JointPositions(skeleton, RestPose(skeleton)).row(1);
  // Some skeletons have foot joints beyond the roles, such as heels.
  Eigen::RowVectorXd clearance = rest.cwiseMin(kBodyClearance);
  for (const int foot : skeleton.feet) {
    if (foot >= 0) clearance[foot] = rest[foot];
  }
  return clearance;
}

double HeightAboveFloor(const Skeleton& skeleton, const Pose& pose) {
  return (JointPositions(skeleton, pose).row(1) - FloorClearance(skeleton)).minCoeff();
}

}  // namespace choreo
