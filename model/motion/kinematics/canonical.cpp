#include "model/motion/kinematics/canonical.h"

#include <cmath>
#include <utility>

#include "model/motion/rotation.h"

namespace choreo {

GroundFrame GroundFrame::Of(const Pose& pose) {
  GroundFrame frame;
  frame.origin = {pose.root_position.x(), 0.0, pose.root_position.z()};
  frame.heading = Heading(ExpMap(pose.rotations.col(0)));
  return frame;
}

Pose GroundFrame::ToLocal(const Pose& world) const {
  const Eigen::Matrix3d turn = HeadingRotation(-heading);
  Pose local = world;
  local.root_position = ToLocal(world.root_position);
  local.rotations.col(0) = LogMap(turn * ExpMap(world.rotations.col(0)));
  return local;
}

Eigen::Vector3d GroundFrame::ToLocal(const Eigen::Vector3d& world) const {
  return HeadingRotation(-heading) * (world - origin);
}

GroundFrame GroundFrame::ToLocal(const GroundFrame& world) const {
  return {ToLocal(world.origin), world.heading - heading};
}

Pose GroundFrame::ToWorld(const Pose& local) const {
  const Eigen::Matrix3d turn = HeadingRotation(heading);
  Pose world = local;
  world.root_position = turn * local.root_position + origin;
  world.rotations.col(0) = LogMap(turn * ExpMap(local.rotations.col(0)));
  return world;
}

Eigen::Vector3d UpOf(const Pose& pose) {
  return ExpMap(pose.rotations.col(0)).transpose() * Eigen::Vector3d::UnitY();
}

double TurnOver(const Pose& from, std::span<const Pose> poses) {
  double heading = GroundFrame::Of(from).heading, turn = 0;
  for (const Pose& pose : poses) {
    const double now = GroundFrame::Of(pose).heading;
    turn += WrapAngle(now - std::exchange(heading, now));
  }
  return turn;
}

double MeanFacing(std::span<const Pose> poses) {
  double sideways = 0, ahead = 0;
  for (const Pose& pose : poses) {
    const double heading = GroundFrame::Of(pose).heading;
    sideways += std::sin(heading);
    ahead += std::cos(heading);
  }
  return std::atan2(sideways, ahead);
}

}  // namespace choreo
