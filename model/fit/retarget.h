#pragma once

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A motion of one skeleton danced by another: joints that play the same role, and heads and hands
/// of the same name, go the same ways, travel is scaled by the legs, and the body is as far above
/// the floor as it was. A fit (fit/fit_clip.h): frames are consecutive, or a single one. Between
/// skeletons of the same bones the motion stays as it is. Throws Error(kInvalidArgument) naming a
/// role (Skeleton::RequireRoles) that either lacks.
Motion Retarget(const Skeleton& from, const Motion& motion, const Skeleton& to);
Pose Retarget(const Skeleton& from, const Pose& pose, const Skeleton& to);

}  // namespace choreo
