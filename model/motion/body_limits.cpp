#include "model/motion/body_limits.h"

#include <algorithm>
#include <utility>

#include "model/motion/kinematics.h"

namespace choreo {

FastStep FindFastestStep(const Skeleton& skeleton, const Pose& before, std::span<const Pose> poses,
                         double fps) {
  FastStep fastest;
  Eigen::Matrix3Xd last = JointPositions(skeleton, before);
  for (size_t i = 0; i < poses.size(); ++i) {
    Eigen::Matrix3Xd now = JointPositions(skeleton, poses[i]);
    Eigen::Index joint = 0;
    const double m_per_s = (now - last).colwise().norm().maxCoeff(&joint) * fps;
    if (m_per_s > fastest.m_per_s) fastest = {m_per_s, static_cast<int>(joint), i};
    last = std::move(now);
  }
  return fastest;
}

double SpeedExcess(const Eigen::RowVectorXd& speeds) {
  return std::max(speeds.maxCoeff() / kFastestJoint, speeds.mean() / kFastestBody);
}

double SpeedExcess(const Skeleton& skeleton, const Pose& before, std::span<const Pose> poses,
                   double fps) {
  double most = 0;
  Eigen::Matrix3Xd last = JointPositions(skeleton, before);
  for (const Pose& pose : poses) {
    Eigen::Matrix3Xd now = JointPositions(skeleton, pose);
    most = std::max(most, SpeedExcess((now - last).colwise().norm() * fps));
    last = std::move(now);
  }
  return most;
}

}  // namespace choreo
