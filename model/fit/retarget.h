#pragma once

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Retargets a motion to another skeleton by a fit (fit/solver/fit_clip.h), so frames must be
/// consecutive. Joints with the same role, and heads and hands with the same name, move alike.
/// Travel scales with the legs; the height above the floor stays. Between skeletons with the same
/// bones the motion is unchanged. Throws Error(kInvalidArgument), naming a role
/// (Skeleton::RequireRoles) that either skeleton lacks.
Motion Retarget(const Skeleton& from, const Motion& motion, const Skeleton& to);
/// The same for a single pose.
Pose Retarget(const Skeleton& from, const Pose& pose, const Skeleton& to);

}  // namespace choreo
