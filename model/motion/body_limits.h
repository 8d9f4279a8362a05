#pragma once

#include <span>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// What bodies can't do, though what is drawn for them may. Pure functions.
namespace choreo {

/// Knees and elbows bend one way, until the limb is folded: the bend of each about its hinge is led
/// softly to a stop at 0 and at 2.7 radians. One that is a tenth from both stays as it is.
void LimitHinges(const Skeleton& skeleton, std::span<Pose> poses);

/// Whoever dances for seconds touches the floor: by the last pose the root is as much lower, or
/// higher, as the lowest foot of all poses was above the floor, or below it. The first poses stay.
void ReturnToFloor(const Skeleton& skeleton, std::span<Pose> poses);

}  // namespace choreo
