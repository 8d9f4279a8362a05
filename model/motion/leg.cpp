#include "model/motion/leg.h"

#include <algorithm>
#include <cmath>

#include "model/motion/limb.h"

namespace choreo {

std::array<Leg, 2> Leg::Of(const Skeleton& skeleton) {
  return {Leg{skeleton.left_hip, skeleton.left_knee, skeleton.feet[0], skeleton.feet[1]},
          Leg{skeleton.right_hip, skeleton.right_knee, skeleton.feet[2], skeleton.feet[3]}};
}

bool Leg::In(const Skeleton& skeleton) {
  return std::ranges::all_of(Of(skeleton), [&](const Leg& leg) {
    const auto follows = [&](int child, int parent) {
      return child > 0 && parent > 0 && skeleton.parents[static_cast<size_t>(child)] == parent;
    };
    return follows(leg.knee, leg.hip) && follows(leg.ankle, leg.knee) &&
           follows(leg.toes, leg.ankle);
  });
}

double Reach(const Leg& leg, const JointPlacement& placement, const Eigen::Vector3d& toes) {
  const auto at = [&](int joint) -> Eigen::Vector3d { return placement.positions.col(joint); };
  const Eigen::Vector3d ankle = toes - (at(leg.toes) - at(leg.ankle));
  return (ankle - at(leg.hip)).norm() /
         ((at(leg.knee) - at(leg.hip)).norm() + (at(leg.ankle) - at(leg.knee)).norm());
}

Eigen::Vector3d WithinReach(const Leg& leg, const JointPlacement& placement,
                            const Eigen::Vector3d& toes, double most) {
  const Eigen::Vector3d now = placement.positions.col(leg.toes), way = toes - now;
  const Eigen::Vector3d from =
      placement.positions.col(leg.ankle) - placement.positions.col(leg.hip);
  const double length = from.norm() / Reach(leg, placement, now);
  const double farthest = std::max(most * length, from.norm());
  if ((from + way).norm() <= farthest) return toes;
  // |from + share way| = farthest; the root that is not behind.
  const double a = way.squaredNorm(), b = from.dot(way);
  const double c = from.squaredNorm() - farthest * farthest;
  const double share = (std::sqrt(std::max(0.0, b * b - a * c)) - b) / a;
  return now + std::clamp(share, 0.0, 1.0) * way;
}

void PlaceToes(const Leg& leg, const Skeleton& skeleton, const JointPlacement& placement,
               const Eigen::Vector3d& toes, Pose* pose) {
  const auto at = [&](int joint) -> Eigen::Vector3d { return placement.positions.col(joint); };
  const Eigen::Vector3d goal = toes - (at(leg.toes) - at(leg.ankle)) - at(leg.hip);
  const Eigen::Vector3d hinge = placement.rotations[static_cast<size_t>(leg.hip)].col(0);
  PlaceEnd({leg.hip, leg.knee, leg.ankle}, hinge, skeleton, placement, goal, pose);
}

}  // namespace choreo
