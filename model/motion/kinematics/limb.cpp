#include "model/motion/kinematics/limb.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

// The last share of a limb's length, over which it straightens softly. Near full length a
// millimetre of reach changes the bend by six degrees, and an exact knee would snap.
constexpr double kSoftShare = 0.04;
// Sine of the bend below which the knee's hinge axis, not its bend, determines the plane.
constexpr double kHingeWeight = 0.02;
constexpr double kStraightTurn = 200 / kDegrees;  // radians a second for a straight limb,
constexpr double kFreedom = 30;                   // 1/s: and this much more per radian of bend

/// A knee or elbow with one axis, between bones of lengths `a` and `b`. `in_plane`: the share of
/// the lower bone across the axis, which turns.
struct Knee {
  double a, b, in_plane;

  double Straight() const { return std::sqrt(a * a + b * b + 2 * a * b * in_plane); }

  // The bend, radians, at this distance between the limb's ends. Exact except in the soft zone,
  // where the limb straightens ever more slowly and never fully.
  double SoftBend(double distance) const {
    const double straight = Straight(), zone = kSoftShare * straight;
    const double beyond = distance - (straight - zone);
    const double soft = beyond > 0 ? straight - zone * std::exp(-beyond / zone) : distance;
    return std::acos(std::clamp((soft * soft - a * a - b * b) / (2 * a * b * in_plane), -1.0, 1.0));
  }

  // The bend at `distance` for a knee that is bent by `bend` at distance `present`: near `present`
  // that bend, even if straight or backwards; further away, SoftBend.
  double BendFrom(double bend, double present, double distance) const {
    const double fades = 4 * kSoftShare * Straight();
    const double near = std::max(0.0, 1 - std::abs(distance - present) / fades);
    return SoftBend(distance) + near * near * (bend - SoftBend(present));
  }
};

struct Bend {
  Eigen::Vector3d thigh, shin, axis;  // about which the ankle swings backwards, across the thigh
  double angle;
};

// The more a leg bends about its hinge, the more its plane counts. A knee bent backwards or
// sideways bends forward from there.
Bend FindBend(const Limb& limb, const Eigen::Vector3d& hinge, const JointPlacement& placement) {
  const auto at = [&](int joint) -> Eigen::Vector3d { return placement.positions.col(joint); };
  const Eigen::Vector3d thigh = at(limb.middle) - at(limb.upper);
  const Eigen::Vector3d shin = at(limb.end) - at(limb.middle);
  const Eigen::Vector3d along = thigh.normalized();
  const Eigen::Vector3d plane = along.cross(shin) / shin.norm();
  const double forward = std::max(0.0, plane.dot(hinge)) / std::max(plane.norm(), 1e-12);
  const Eigen::Vector3d axis =
      (forward * plane + kHingeWeight * (hinge - hinge.dot(along) * along)).normalized();
  return {thigh, shin, axis, std::atan2(axis.dot(along.cross(shin)), along.dot(shin))};
}

Eigen::Vector3d HingeOf(const Leg& leg, const JointPlacement& placement) {
  return placement.rotations[static_cast<size_t>(leg.hip)].col(0);
}

}  // namespace

int FirstChild(const Skeleton& skeleton, int joint) {
  const auto child = std::ranges::find(skeleton.parents, joint);
  return child == skeleton.parents.end() ? -1 : static_cast<int>(child - skeleton.parents.begin());
}

BendRange NextBend(double bend, double seconds) {
  const double room = kStraightTurn * seconds, more = kFreedom * seconds;
  const double beyond = bend - kStraightBend;
  return {beyond > room ? kStraightBend + (beyond - room) / (1 + more) : bend - room,
          bend + room + more * std::max(0.0, beyond)};
}

double PlaceEnd(const Limb& limb, const Eigen::Vector3d& hinge, const Skeleton& skeleton,
                const JointPlacement& placement, const Eigen::Vector3d& goal, Pose* pose,
                const BendRange& range) {
  const auto turned = [&](int joint) -> const Eigen::Matrix3d& {
    return placement.rotations[static_cast<size_t>(joint)];
  };
  const auto [thigh, shin, axis, bend] = FindBend(limb, hinge, placement);
  const double a = thigh.norm(), b = shin.norm();
  const double distance = std::max(goal.norm(), std::abs(a - b) + 0.05 * b);
  const double in_plane = std::max(0.1, (shin - shin.dot(axis) * axis).norm() / b);
  const double new_bend =
      std::clamp(Knee{a, b, in_plane}.BendFrom(bend, (thigh + shin).norm(), distance), range.least,
                 range.most);
  const Eigen::Matrix3d knee = Eigen::AngleAxisd(new_bend - bend, axis).toRotationMatrix();
  const Eigen::Matrix3d swing =
      Eigen::Quaterniond::FromTwoVectors(thigh + knee * shin, goal).toRotationMatrix();

  const Eigen::Matrix3d& pelvis = turned(skeleton.parents[static_cast<size_t>(limb.upper)]);
  const Eigen::Matrix3d new_hip = swing * turned(limb.upper);
  const Eigen::Matrix3d new_knee = swing * knee * turned(limb.middle);
  const auto set = [&](int joint, const Eigen::Matrix3d& local) {
    pose->rotations.col(joint) = NearestBranch(LogMap(local), pose->rotations.col(joint));
  };
  set(limb.upper, pelvis.transpose() * new_hip);
  set(limb.middle, new_hip.transpose() * new_knee);
  set(limb.end, new_knee.transpose() * turned(limb.end));
  return new_bend;
}

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
  const double reach = Reach(leg, placement, toes);
  const double farthest = std::max(most, Reach(leg, placement, placement.positions.col(leg.toes)));
  if (reach <= farthest) return toes;
  const Eigen::Vector3d ankle =
      placement.positions.col(leg.ankle) + toes - placement.positions.col(leg.toes);
  return toes - (1 - farthest / reach) * (ankle - placement.positions.col(leg.hip));
}

double PlaceToes(const Leg& leg, const Skeleton& skeleton, const JointPlacement& placement,
                 const Eigen::Vector3d& toes, Pose* pose, const BendRange& range) {
  const auto at = [&](int joint) -> Eigen::Vector3d { return placement.positions.col(joint); };
  const Eigen::Vector3d goal = toes - (at(leg.toes) - at(leg.ankle)) - at(leg.hip);
  return PlaceEnd({leg.hip, leg.knee, leg.ankle}, HingeOf(leg, placement), skeleton, placement,
                  goal, pose, range);
}

double KneeBend(const Leg& leg, const JointPlacement& placement) {
  return FindBend({leg.hip, leg.knee, leg.ankle}, HingeOf(leg, placement), placement).angle;
}

}  // namespace choreo
