#include "model/motion/pose/body_limits.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "model/motion/kinematics/kinematics.h"

namespace choreo {

namespace {

// The speeds of all joints in the step to each pose, metres per second.
std::vector<Eigen::RowVectorXd> StepSpeeds(const Skeleton& skeleton, const Pose& before,
                                           std::span<const Pose> poses, double fps) {
  std::vector<Eigen::RowVectorXd> speeds;
  Eigen::Matrix3Xd last = JointPositions(skeleton, before);
  for (const Pose& pose : poses) {
    Eigen::Matrix3Xd now = JointPositions(skeleton, pose);
    speeds.emplace_back((now - last).colwise().norm() * fps);
    last = std::move(now);
  }
  return speeds;
}

}  // namespace

FastStep FindFastestStep(const Skeleton& skeleton, const Pose& before, std::span<const Pose> poses,
                         double fps) {
  FastStep fastest;
  const auto speeds = StepSpeeds(skeleton, before, poses, fps);
  for (size_t i = 0; i < speeds.size(); ++i) {
    Eigen::Index joint = 0;
    const double m_per_s = speeds[i].maxCoeff(&joint);
    if (m_per_s > fastest.m_per_s) fastest = {m_per_s, static_cast<int>(joint), i};
  }
  return fastest;
}

double SpeedExcess(const Eigen::RowVectorXd& speeds) {
  return std::max(speeds.maxCoeff() / kFastestJoint, speeds.mean() / kFastestBody);
}

double SpeedExcess(const Skeleton& skeleton, const Pose& before, std::span<const Pose> poses,
                   double fps) {
  double most = 0;
  for (const Eigen::RowVectorXd& speeds : StepSpeeds(skeleton, before, poses, fps))
    most = std::max(most, SpeedExcess(speeds));
  return most;
}

}  // namespace choreo
