#pragma once

#include <Eigen/Core>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// [joints] How far the body extends below each joint that touches the floor, metres: for a foot
/// joint its height at rest, for others at most 5 cm.
Eigen::RowVectorXd FloorClearance(const Skeleton& skeleton);

/// Height of the body's lowest point above the floor, metres, by that clearance.
double HeightAboveFloor(const Skeleton& skeleton, const Pose& pose);

}  // namespace choreo
