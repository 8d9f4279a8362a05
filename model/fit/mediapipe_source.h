#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// The names of MediaPipe Pose's 33 landmarks in its order: "nose", "left_eye_inner", ...
/// "right_foot_index".
const std::vector<std::string>& MediaPipeJointNames();

/// Fits a pose to the landmarks of one picture. `landmarks` [3, 33] are MediaPipe's world
/// landmarks: metres from the middle of the hips, x to the picture's right, y down, z away from the
/// camera. `visibilities` [33], 0 to 1, weight them; priors decide for landmarks that are hardly
/// visible. The result has our bones in the landmarks' directions, and stands near the origin with
/// a foot on the floor. A person who looks into the camera faces +Z. Pure. Throws
/// Error(kInvalidArgument) for numbers that are not finite.
Pose FitMediaPipe(const Eigen::Matrix3Xd& landmarks, std::span<const double> visibilities,
                  const Skeleton& skeleton);

}  // namespace choreo
