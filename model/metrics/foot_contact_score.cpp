#include "model/metrics/foot_contact_score.h"

#include <algorithm>
#include <cmath>

#include "model/core/error.h"

namespace choreo {

double PhysicalFootContact(const Skeleton& skeleton, const JointTrack& track) {
  if (std::ranges::min(skeleton.feet) < 0)
    throw InvalidArgument("skeleton", "lacks a foot joint, which PFC needs");
  double sum = 0, largest = 0;
  int64_t frames = 0;
  for (size_t t = 1; t + 1 < track.size(); ++t, ++frames) {
    // Per frame squared: the rate cancels in |a| / max|a|.
    Eigen::Vector3d acceleration = track[t + 1].col(0) - 2 * track[t].col(0) + track[t - 1].col(0);
    acceleration.y() = std::max(acceleration.y(), 0.0);
    const auto way = [&](int joint) {
      const Eigen::Vector3d step = track[t + 1].col(joint) - track[t].col(joint);
      return std::hypot(step.x(), step.z());
    };
    const double left = std::min(way(skeleton.feet[0]), way(skeleton.feet[1]));
    const double right = std::min(way(skeleton.feet[2]), way(skeleton.feet[3]));
    largest = std::max(largest, acceleration.norm());
    sum += acceleration.norm() * left * right;
  }
  return largest > 0 ? 1e4 * sum / (largest * frames) : 0;
}

}  // namespace choreo
