#include "model/motion/body_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr double kSoftness = 0.03;  // radians of bend over which a hinge is led to a stop
constexpr double kFolded = 2.7;     // radians: a calf on its thigh

// As max(0, bend), but smooth.
double SoftBend(double bend) {
  const double share = bend / kSoftness;
  return share > 30 ? bend : kSoftness * std::log1p(std::exp(share));
}

}  // namespace

void LimitHinges(const Skeleton& skeleton, std::span<Pose> poses) {
  const std::vector<Hinge> hinges = Hinges(skeleton);
  for (Pose& pose : poses) {
    for (const Hinge& hinge : hinges) {
      auto rotation = pose.rotations.col(hinge.joint);
      const double bend = hinge.axis.dot(rotation);
      const double possible = kFolded - SoftBend(kFolded - SoftBend(bend));
      rotation += (possible - bend) * hinge.axis;
    }
  }
}

void ReturnToFloor(const Skeleton& skeleton, std::span<Pose> poses) {
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  double clearance = std::numeric_limits<double>::infinity();
  for (const Pose& pose : poses) {
    const Eigen::Matrix3Xd positions = JointPositions(skeleton, pose);
    for (const int foot : skeleton.feet) {
      if (foot >= 0) clearance = std::min(clearance, positions(1, foot) - rest(1, foot));
    }
  }
  if (!std::isfinite(clearance)) return;
  for (size_t i = 0; i < poses.size(); ++i) {
    const double u = static_cast<double>(i + 1) / static_cast<double>(poses.size());
    poses[i].root_position.y() -= u * u * (3 - 2 * u) * clearance;
  }
}

}  // namespace choreo
