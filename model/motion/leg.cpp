#include "model/motion/leg.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kStraight = 0.9995;  // share of its length that a leg may be stretched to
// Sine of the bend below which the knee's own hinge, not the bend, tells the plane.
constexpr double kHingeWeight = 0.02;

}  // namespace

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

void PlaceToes(const Leg& leg, const Skeleton& skeleton, const JointPlacement& placement,
               const Eigen::Vector3d& toes, Pose* pose) {
  const auto at = [&](int joint) -> Eigen::Vector3d { return placement.positions.col(joint); };
  const auto turned = [&](int joint) -> const Eigen::Matrix3d& {
    return placement.rotations[static_cast<size_t>(joint)];
  };
  const Eigen::Vector3d hip = at(leg.hip);
  const Eigen::Vector3d thigh = at(leg.knee) - hip, shin = at(leg.ankle) - at(leg.knee);
  const double a = thigh.norm(), b = shin.norm();
  const Eigen::Vector3d goal = toes - (at(leg.toes) - at(leg.ankle)) - hip;
  const double distance = std::clamp(goal.norm(), std::abs(a - b) + 0.05 * b, kStraight * (a + b));

  // The law of cosines gives the bend; about the thigh's +X the ankle swings backwards.
  const double bend =
      std::acos(std::clamp((distance * distance - a * a - b * b) / (2 * a * b), -1.0, 1.0));
  const Eigen::Vector3d hinge = turned(leg.hip).col(0);
  const Eigen::Vector3d along = thigh / a;
  const Eigen::Vector3d across =
      (thigh.cross(shin) / (a * b) + kHingeWeight * hinge).cross(along).normalized();
  const Eigen::Vector3d bent = b * (std::cos(bend) * along + std::sin(bend) * across);
  const Eigen::Matrix3d knee = Eigen::Quaterniond::FromTwoVectors(shin, bent).toRotationMatrix();
  const Eigen::Matrix3d swing =
      Eigen::Quaterniond::FromTwoVectors(thigh + knee * shin, goal).toRotationMatrix();

  const Eigen::Matrix3d& pelvis = turned(skeleton.parents[static_cast<size_t>(leg.hip)]);
  const Eigen::Matrix3d new_hip = swing * turned(leg.hip);
  const Eigen::Matrix3d new_knee = swing * knee * turned(leg.knee);
  const auto set = [&](int joint, const Eigen::Matrix3d& local) {
    pose->rotations.col(joint) = NearestBranch(LogMap(local), pose->rotations.col(joint));
  };
  set(leg.hip, pelvis.transpose() * new_hip);
  set(leg.knee, new_hip.transpose() * new_knee);
  set(leg.ankle, new_knee.transpose() * turned(leg.ankle));
}

}  // namespace choreo
