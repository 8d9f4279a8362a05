#include "model/metrics/snaps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace choreo {
namespace {

constexpr double kStraight = 5 * M_PI / 180;
constexpr double kSpeed = 240 * M_PI / 180;  // a second

// The angle between the bones above and below a hinge.
double Flexion(const Hinge& hinge, int lower, const Eigen::Matrix3Xd& joints) {
  const Eigen::Vector3d above = joints.col(hinge.joint) - joints.col(hinge.upper);
  const Eigen::Vector3d below = joints.col(lower) - joints.col(hinge.joint);
  return std::atan2(above.cross(below).norm(), above.dot(below));
}

}  // namespace

Snaps CountSnaps(const Skeleton& skeleton, double fps, const JointTrack& track) {
  Snaps snaps;
  for (const Hinge& hinge : Hinges(skeleton)) {
    const auto lower = std::ranges::find(skeleton.parents, hinge.joint);
    if (lower == skeleton.parents.end()) continue;
    const auto end = static_cast<int>(lower - skeleton.parents.begin());
    const bool knee = hinge.joint == skeleton.left_knee || hinge.joint == skeleton.right_knee;
    for (size_t t = 1; t < track.size(); ++t) {
      const double before = Flexion(hinge, end, track[t - 1]);
      const double now = Flexion(hinge, end, track[t]);
      if (std::min(before, now) < kStraight && std::abs(now - before) * fps > kSpeed)
        ++(knee ? snaps.knees : snaps.elbows);
    }
  }
  return snaps;
}

}  // namespace choreo
