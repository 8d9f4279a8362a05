#include "model/motion/pose/facing_pose.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {

FacingPose FacingOf(const Skeleton& skeleton, const Pose& pose) {
  FacingPose facing;
  facing.root = pose.root_position;
  facing.heading = GroundFrame::Of(pose).heading;
  const Eigen::Matrix3Xd positions = ForwardKinematics(skeleton, pose).positions;
  const Eigen::AngleAxisd back(-facing.heading, Eigen::Vector3d::UnitY());
  facing.joints =
      back.toRotationMatrix() * (positions.rightCols(positions.cols() - 1).colwise() - facing.root);
  return facing;
}

Eigen::Matrix3Xd PositionsOf(const FacingPose& pose) {
  const Eigen::AngleAxisd turn(pose.heading, Eigen::Vector3d::UnitY());
  Eigen::Matrix3Xd positions(3, pose.joints.cols() + 1);
  positions.col(0) = pose.root;
  positions.rightCols(pose.joints.cols()) =
      (turn.toRotationMatrix() * pose.joints).colwise() + pose.root;
  return positions;
}

double NearestTurn(double heading, double near) {
  const double turn = 2 * std::numbers::pi;
  return heading + turn * std::round((near - heading) / turn);
}

}  // namespace choreo
