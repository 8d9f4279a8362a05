#pragma once

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// How far the doll (doll.h) of a pose is above the floor, metres: 0 where it touches the floor as
/// at rest, below 0 where a part of it would be under the floor. Throws Error(kInvalidArgument) for
/// a pose of another joint count.
double DollAboveFloor(const Skeleton& skeleton, const Pose& pose);

}  // namespace choreo
