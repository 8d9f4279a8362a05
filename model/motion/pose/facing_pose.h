#pragma once

#include <Eigen/Core>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A pose in paper C's form (Section 3.1): place, heading, and the body turned to face +Z.
struct FacingPose {
  Eigen::Vector3d root = Eigen::Vector3d::Zero();  ///< p^r, metres
  double heading = 0;       ///< o^r, radians about +Y; 0 faces +Z, as in GroundFrame
  Eigen::Matrix3Xd joints;  ///< p^b: [3, joints - 1] from the root, turned by -heading, metres
};

FacingPose FacingOf(const Skeleton& skeleton, const Pose& pose);

/// Global joint positions, [3, joints].
Eigen::Matrix3Xd PositionsOf(const FacingPose& pose);

/// `heading` plus the whole turns that bring it nearest to `near`.
double NearestTurn(double heading, double near);

}  // namespace choreo
