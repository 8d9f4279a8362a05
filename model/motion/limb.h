#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "model/motion/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Radians of bend: a limb below it is straight.
inline constexpr double kStraightBend = 5 / kDegrees;

/// Two bones and what hangs on them: hip, knee, ankle, or shoulder, elbow, wrist; by joint index, a
/// chain.
struct Limb {
  int upper = -1, middle = -1, end = -1;
};

/// What a limb's bend may be: radians, 0 is straight, forward is positive.
struct BendRange {
  double least = -M_PI, most = M_PI;
};

/// What a limb that is bent by `bend` may come to in `seconds`. On a straight one a centimetre is
/// ten degrees: what asks them of one frame would snap it.
BendRange NextBend(double bend, double seconds);

/// Two-bone inverse kinematics: turns the upper two joints so that the end comes to `goal`, seen
/// from the upper joint, and keeps its global rotation. The limb bends in its present plane, a
/// straight one about `hinge` (a direction in the world by which it bends as a body does).
/// Continuous in pose and goal; near its full length the end may stay behind by a centimetre, out
/// of reach of a bend in `range` the limb points at the goal. `placement` is of `pose`; afterwards
/// it is stale. Returns the bend.
double PlaceEnd(const Limb& limb, const Eigen::Vector3d& hinge, const Skeleton& skeleton,
                const JointPlacement& placement, const Eigen::Vector3d& goal, Pose* pose,
                const BendRange& range = {});

/// Hip, knee, ankle and toes of one leg, by joint index.
struct Leg {
  int hip = -1, knee = -1, ankle = -1, toes = -1;

  /// Whether both legs are chains of these four joints.
  static bool In(const Skeleton& skeleton);
  /// Left, right; of a skeleton that has them.
  static std::array<Leg, 2> Of(const Skeleton& skeleton);
};

/// How far the toes can be from the hip with the foot turned as it is, as a share of the length of
/// thigh and shin: below 1 the ankle of `placement` could be put where `toes` asks for it.
double Reach(const Leg& leg, const JointPlacement& placement, const Eigen::Vector3d& toes);

/// `toes`, or where the leg is as straight as `most` (a Reach) on the way there from where
/// `placement` has the toes; they stay where that is farther already.
Eigen::Vector3d WithinReach(const Leg& leg, const JointPlacement& placement,
                            const Eigen::Vector3d& toes, double most);

/// Turns hip and knee so that the toes come to `toes`, the foot keeping its global rotation
/// (PlaceEnd, whose bend it returns); a straight knee bends forward. `toes` stands in the frame of
/// `pose`.
double PlaceToes(const Leg& leg, const Skeleton& skeleton, const JointPlacement& placement,
                 const Eigen::Vector3d& toes, Pose* pose, const BendRange& range = {});

/// By how much the knee is bent, as PlaceToes returns it.
double KneeBend(const Leg& leg, const JointPlacement& placement);

}  // namespace choreo
