#include "model/motion/kinematics/velocity.h"

#include "model/motion/rotation.h"

namespace choreo {

RootVelocity RootVelocityBetween(const Pose& earlier, const Pose& later, double fps) {
  const double heading = Heading(ExpMap(earlier.rotations.col(0)));
  const double turn = WrapAngle(Heading(ExpMap(later.rotations.col(0))) - heading);
  const Eigen::Vector3d step =
      HeadingRotation(-heading) * (later.root_position - earlier.root_position);
  return {.forward = step.z() * fps, .sideways = step.x() * fps, .yaw = turn * fps};
}

double JointJerk(const Eigen::Vector3d& first, const Eigen::Vector3d& second,
                 const Eigen::Vector3d& third, const Eigen::Vector3d& fourth, double fps) {
  return (fourth - 3 * third + 3 * second - first).norm() * fps * fps * fps;
}

}  // namespace choreo
