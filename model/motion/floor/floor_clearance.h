#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Metres from the joints of spine and hips to the skin of seat, back and belly.
inline constexpr double kTrunkDepth = 0.1;

/// How far the body extends below each joint that touches the floor, metres, [joints]: a foot
/// joint's height at rest; at most kTrunkDepth for the trunk's joints, and 5 cm for others.
Eigen::RowVectorXd FloorClearance(const Skeleton& skeleton);

/// The height of the body's lowest point above the floor, metres, given FloorClearance.
double HeightAboveFloor(const Skeleton& skeleton, const Pose& pose);

/// The joints, other than the feet's, that touch the floor or nearly do: knees, hands, seat.
/// `clearance`: FloorClearance. `joints`: [3, joints], metres.
std::vector<int> JointsOnFloor(const Skeleton& skeleton, const Eigen::RowVectorXd& clearance,
                               const Eigen::Matrix3Xd& joints);
/// Whether the pose has such joints: its body sits, lies or kneels.
bool RestsOnFloor(const Skeleton& skeleton, const Pose& pose);

}  // namespace choreo
