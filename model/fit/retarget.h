#pragma once

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Moves a motion to another skeleton: joints with the same role, and heads and hands with the same
/// name, move alike; travel scales with the legs, and the height above the floor stays. It is a fit
/// (fit/fit_clip.h): frames must be consecutive, or a single one. Between skeletons with the same
/// bones the motion is unchanged. Throws Error(kInvalidArgument) naming a role
/// (Skeleton::RequireRoles) that either lacks.
Motion Retarget(const Skeleton& from, const Motion& motion, const Skeleton& to);
Pose Retarget(const Skeleton& from, const Pose& pose, const Skeleton& to);

}  // namespace choreo
