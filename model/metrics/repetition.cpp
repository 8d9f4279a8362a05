#include "model/metrics/repetition.h"

#include <cmath>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

constexpr double kWindow = 0.5;         // seconds
constexpr double kLag = 1.0;            // seconds
constexpr double kRestingSpeed = 0.15;  // m/s
constexpr double kAlike = 0.05;         // metres

}  // namespace

Repetition MeasureRepetition(const Skeleton& skeleton, std::span<const Pose> poses, double fps,
                             int from) {
  const int window = static_cast<int>(std::lround(kWindow * fps));
  const int lag = static_cast<int>(std::lround(kLag * fps));
  const int windows = static_cast<int>(poses.size()) - window + 1;
  if (from < 0 || from >= windows) {
    throw InvalidArgument("poses", "no window of " + std::to_string(window) +
                                       " frames begins at frame " + std::to_string(from) + " of " +
                                       std::to_string(poses.size()));
  }
  std::vector<Eigen::Matrix3Xd> local;
  for (const Pose& pose : poses) {
    local.push_back(JointPositions(skeleton, GroundFrame::Of(pose).ToLocal(pose)));
  }
  const auto is_still = [&](int begin) {
    Eigen::RowVectorXd way = Eigen::RowVectorXd::Zero(skeleton.joints());
    for (int i = begin + 1; i < begin + window; ++i)
      way += (local[i] - local[i - 1]).colwise().norm();
    return way.maxCoeff() / (window - 1) * fps < kRestingSpeed;
  };
  const auto are_alike = [&](int a, int b) {
    double distance = 0;
    for (int i = 0; i < window; ++i) {
      distance += (local[a + i] - local[b + i]).colwise().norm().mean();
      if (distance >= kAlike * window) return false;
    }
    return true;
  };
  int frozen = 0, repeated = 0;
  for (int begin = from; begin < windows; ++begin) {
    if (is_still(begin)) {
      ++frozen;
      continue;
    }
    int before = 0;
    while (before <= begin - lag && !are_alike(begin, before)) ++before;
    repeated += before <= begin - lag;
  }
  const double count = windows - from;
  return {frozen / count, repeated / count};
}

}  // namespace choreo
