#pragma once

#include <Eigen/Core>
#include <array>

#include "model/motion/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

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

/// Two-bone inverse kinematics: turns hip and knee so that the toes come to `toes`, the foot
/// keeping its global rotation. The knee bends in its present plane (a straight leg, and one that is
/// bent backwards: forward), and the leg turns about the hip by the smallest angle. Continuous in
/// pose and `toes`: asked for what is there, it changes nothing; towards its full length a leg
/// straightens ever more slowly, so that toes may stay behind by a centimetre, and out of reach it
/// points at them. `placement` is the forward kinematics of `pose`, in whose frame `toes` stands;
/// afterwards it is stale. Rotations stay on their branch.
void PlaceToes(const Leg& leg, const Skeleton& skeleton, const JointPlacement& placement,
               const Eigen::Vector3d& toes, Pose* pose);

}  // namespace choreo
