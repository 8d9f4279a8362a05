#pragma once

#include <Eigen/Core>

#include "model/motion/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Two bones and what hangs on them: hip, knee, ankle, or shoulder, elbow, wrist; by joint index, a
/// chain.
struct Limb {
  int upper = -1, middle = -1, end = -1;
};

/// Two-bone inverse kinematics: turns the upper two joints so that the end comes to `goal`, seen
/// from the upper joint, and keeps its global rotation. The limb bends in its present plane (a
/// straight one, and one that is bent the wrong way: about `hinge`, a direction in the world by
/// which it bends as a body does), and swings by the smallest angle. Continuous in pose and goal:
/// asked for what is there, it changes nothing; towards its full length a limb straightens ever
/// more slowly, so that the end may stay behind by a centimetre, and out of reach it points at the
/// goal. `placement` is the forward kinematics of `pose`; afterwards it is stale. Rotations stay on
/// their branch.
void PlaceEnd(const Limb& limb, const Eigen::Vector3d& hinge, const Skeleton& skeleton,
              const JointPlacement& placement, const Eigen::Vector3d& goal, Pose* pose);

}  // namespace choreo
