#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/choreo_client.h"

namespace choreo::cli {

/// How a pose is made, as a command line says it, in the order in which it is done.
struct PoseRecipe {
  /// What ReadPose takes (pose_source.h), or "rest": upright, arms out to the sides.
  std::string from = "rest";
  /// Files of poses that were seen in a photo (photo_pose.h), in place of `from`: at most one.
  std::string from_landmarks = {}, from_smpl = {};
  /// "left_elbow=90", "left_shoulder=10,0,-45": joints in degrees (motion/joint_angles.h).
  std::vector<std::string> set;
  std::optional<double> height_m;  ///< of the body's lowest point above the floor; none: as it is
  /// "right_hand=0.3,1.6,0.2": joints drawn to places, metres (fit/inverse_kinematics.h). Of
  /// joints of the feet the height is the sole's: 0 is the floor.
  std::vector<std::string> reach;
  bool mirror = false;  ///< left becomes right
};

/// Makes the pose. Its mask is that of `from`, with the joints that were set. Throws
/// Error(kInvalidArgument) whose field is the option as it was given, "--set left_elbow=200",
/// naming joint, value and limit; for a target that is out of reach it says how far off the joint
/// ended. Errors of `from` are ReadPose's.
client::KeyPose MakePose(const PoseRecipe& recipe, const Skeleton& skeleton);

}  // namespace choreo::cli
