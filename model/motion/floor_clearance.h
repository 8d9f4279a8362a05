#pragma once

#include <Eigen/Core>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// How far the body extends below each joint that touches the floor, metres, [joints]: a foot
/// joint's height at rest; at most 5 cm for others.
Eigen::RowVectorXd FloorClearance(const Skeleton& skeleton);

/// The height of the body's lowest point above the floor, metres, given FloorClearance.
double HeightAboveFloor(const Skeleton& skeleton, const Pose& pose);

}  // namespace choreo
