#include "model/metrics/kinetic_features.h"

#include <algorithm>
#include <string>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr int64_t kReach = 2;  // frames to either side

// Means over a sliding window, shorter at the ends.
JointTrack Smooth(const JointTrack& track) {
  const auto frames = static_cast<int64_t>(track.size());
  JointTrack smooth;
  for (int64_t t = 0; t < frames; ++t) {
    const int64_t first = std::max<int64_t>(0, t - kReach);
    const int64_t last = std::min(frames - 1, t + kReach);
    Eigen::Matrix3Xd sum = track[first];
    for (int64_t i = first + 1; i <= last; ++i) sum += track[i];
    smooth.push_back(sum / static_cast<double>(last - first + 1));
  }
  return smooth;
}

JointTrack Differences(const JointTrack& track, double fps) {
  JointTrack steps;
  for (size_t t = 1; t < track.size(); ++t) steps.push_back((track[t] - track[t - 1]) * fps);
  return steps;
}

}  // namespace

Eigen::VectorXd KineticFeatures(const JointTrack& track, double fps) {
  if (track.size() < 3)
    throw InvalidArgument("track", std::to_string(track.size()) + " frames, 3 are needed");
  const JointTrack steps = Differences(track, fps);
  const JointTrack velocities = Smooth(steps), accelerations = Smooth(Differences(steps, fps));
  const Eigen::Index joints = track[0].cols();
  Eigen::VectorXd features = Eigen::VectorXd::Zero(3 * joints);
  for (const Eigen::Matrix3Xd& velocity : velocities) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      const double vertical = velocity(1, j) * velocity(1, j);
      features[3 * j] += velocity.col(j).squaredNorm() - vertical;
      features[3 * j + 1] += vertical;
    }
  }
  for (Eigen::Index j = 0; j < joints; ++j) {
    features.segment<2>(3 * j) /= static_cast<double>(velocities.size());
    for (const Eigen::Matrix3Xd& acceleration : accelerations)
      features[3 * j + 2] += acceleration.col(j).norm();
    features[3 * j + 2] /= static_cast<double>(accelerations.size());
  }
  return features;
}

}  // namespace choreo
