#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "model/motion/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Radians of bend below which a limb counts as straight.
inline constexpr double kStraightBend = 5 / kDegrees;

/// Two bones and what hangs on them: hip, knee, ankle or shoulder, elbow, wrist. Joint indices of a
/// chain.
struct Limb {
  int upper = -1, middle = -1, end = -1;
};

/// Range of a limb's bend: radians, 0 is straight, forward is positive.
struct BendRange {
  double least = -M_PI, most = M_PI;
};

/// The bends that a limb bent by `bend` may reach within `seconds`. On a straight limb a centimetre
/// is ten degrees; reaching it in one frame would snap.
BendRange NextBend(double bend, double seconds);

/// Two-bone inverse kinematics: turns the upper two joints so that the end reaches `goal`, given
/// relative to the upper joint, and keeps the end's global rotation. A bent limb bends in its
/// present plane, a straight one about `hinge` (a world direction about which it bends naturally).
/// Continuous in pose and goal; near full length the end may miss by a centimetre, and beyond the
/// bends in `range` the limb points at the goal. `placement` is of `pose` and is stale afterwards.
/// Returns the bend.
double PlaceEnd(const Limb& limb, const Eigen::Vector3d& hinge, const Skeleton& skeleton,
                const JointPlacement& placement, const Eigen::Vector3d& goal, Pose* pose,
                const BendRange& range = {});

/// Hip, knee, ankle and toes of one leg, by joint index.
struct Leg {
  int hip = -1, knee = -1, ankle = -1, toes = -1;

  /// Whether both legs of the skeleton are such chains.
  static bool In(const Skeleton& skeleton);
  /// The left and the right leg of a skeleton that has them.
  static std::array<Leg, 2> Of(const Skeleton& skeleton);
};

/// How far `toes` would be from the hip with the foot turned as it is, as a share of the length of
/// thigh and shin: below 1 the ankle of `placement` can get there.
double Reach(const Leg& leg, const JointPlacement& placement, const Eigen::Vector3d& toes);

/// `toes`, or the nearest point to them at which the leg is as straight as `most` (a Reach) or, if
/// that is more, as it already is.
Eigen::Vector3d WithinReach(const Leg& leg, const JointPlacement& placement,
                            const Eigen::Vector3d& toes, double most);

/// Turns hip and knee so that the toes reach `toes` (in the frame of `pose`) and the foot keeps its
/// global rotation, by PlaceEnd, whose bend it returns. A straight knee bends forward.
double PlaceToes(const Leg& leg, const Skeleton& skeleton, const JointPlacement& placement,
                 const Eigen::Vector3d& toes, Pose* pose, const BendRange& range = {});

/// The knee's bend, as PlaceToes returns it.
double KneeBend(const Leg& leg, const JointPlacement& placement);

}  // namespace choreo
