#include "model/motion/kinematics/trunk_line.h"

#include <array>
#include <limits>
#include <utility>

#include "model/motion/kinematics/limb.h"
#include "model/motion/nearest_points.h"

namespace choreo {

using Eigen::Vector3d;

std::vector<Arm> ArmsOf(const Skeleton& skeleton) {
  const std::array shoulders = {skeleton.left_shoulder, skeleton.right_shoulder};
  const std::array elbows = {skeleton.left_elbow, skeleton.right_elbow};
  std::vector<Arm> arms;
  for (size_t side = 0; side < 2; ++side) {
    const int wrist = elbows[side] < 0 ? -1 : FirstChild(skeleton, elbows[side]);
    if (shoulders[side] < 0 || wrist < 0) return {};
    arms.push_back({shoulders[side], elbows[side], wrist, FirstChild(skeleton, wrist)});
  }
  return arms;
}

TrunkLine::TrunkLine(const Skeleton& skeleton)
    : left_shoulder_(skeleton.left_shoulder), right_shoulder_(skeleton.right_shoulder) {
  const auto parent = [&](int joint) { return skeleton.parents[static_cast<size_t>(joint)]; };
  int joint = left_shoulder_;
  while (!IsBelow(right_shoulder_, joint, skeleton.parents)) joint = parent(joint);
  for (; joint >= 0; joint = parent(joint)) joints_.push_back(joint);
}

Vector3d TrunkLine::WayTo(const Arm& arm, const Eigen::Matrix3Xd& positions,
                          const Eigen::Matrix3d& turn) const {
  const Vector3d shoulder = positions.col(arm.shoulder);
  const auto turned = [&](int joint) -> Vector3d {
    return shoulder + turn * (positions.col(joint) - shoulder);
  };
  const Vector3d elbow = turned(arm.elbow), wrist = turned(arm.wrist);
  // Fingers are as long as the palm.
  const Vector3d tip = arm.hand < 0 ? wrist : Vector3d(2 * turned(arm.hand) - wrist);
  Vector3d above = (positions.col(left_shoulder_) + positions.col(right_shoulder_)) / 2;
  Vector3d way = Vector3d::Constant(std::numeric_limits<double>::infinity());
  for (const int joint : joints_) {
    const Vector3d below = positions.col(joint);
    for (const auto& [a, b] : {std::pair(elbow, wrist), std::pair(wrist, tip)}) {
      const auto [on_trunk, on_arm] = NearestPoints(below, above, a, b);
      const Vector3d one = a + on_arm * (b - a) - below - on_trunk * (above - below);
      if (one.squaredNorm() < way.squaredNorm()) way = one;
    }
    above = below;
  }
  return way;
}

}  // namespace choreo
