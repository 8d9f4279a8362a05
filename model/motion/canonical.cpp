#include "model/motion/canonical.h"

#include <cmath>

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

double MeanFacing(std::span<const Pose> poses) {
  double sideways = 0, ahead = 0;
  for (const Pose& pose : poses) {
    const double heading = Heading(ExpMap(pose.rotations.col(0)));
    sideways += std::sin(heading);
    ahead += std::cos(heading);
  }
  return std::atan2(sideways, ahead);
}

}  // namespace choreo
