#pragma once

#include <Eigen/Core>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// [joints] How much of the body lies below each joint where it touches the floor, metres: below a
/// foot joint as much as at rest, below any other at most 5 cm.
Eigen::RowVectorXd FloorClearance(const Skeleton& skeleton);

/// How far the lowest point of the body is above the floor, metres, by that clearance.
double HeightAboveFloor(const Skeleton& skeleton, const Pose& pose);

}  // namespace choreo
