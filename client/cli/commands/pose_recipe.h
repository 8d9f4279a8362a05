#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/authoring/keys/placing.h"
#include "client/authoring/keys/pose_source.h"
#include "client/choreo_client.h"

namespace choreo::cli {

/// How to make a pose, from a command line. Steps are executed in the order of the members.
struct PoseRecipe {
  /// A source for ReadPose (pose_source.h), or "rest": upright, arms out to the sides.
  std::string from = "rest";
  /// Files with poses from photos (photo_pose.h), instead of `from`: at most one.
  std::string from_landmarks = {}, from_smpl = {};
  /// "left_elbow=90", "left_shoulder=10,0,-45": joints in degrees
  /// (motion/kinematics/joint_angles.h).
  std::vector<std::string> set;
  std::optional<double> height_m;  ///< of the body's lowest point above the floor; none: unchanged
  /// "right_hand=0.3,1.6,0.2": joints moved to places, metres (fit/solver/inverse_kinematics.h).
  /// The height of foot joints is the sole's: 0 is the floor.
  std::vector<std::string> reach;
  bool keeps_hands = false;         ///< and the head in place when the pelvis moves
  bool mirror = false;              ///< swaps left and right
  authoring::Placing placing = {};  ///< over the floor; a library pose is around the origin
};

/// Makes the pose, held like `from`'s. Its mask is `from`'s plus the joints that were set. Throws
/// Error(kInvalidArgument) whose field is the option as given, "--set left_elbow=200", naming
/// joint, value and limit; for a target out of reach it states the remaining distance. Throws as
/// ReadPose does for `from`.
authoring::NamedPose MakePose(const PoseRecipe& recipe, const Skeleton& skeleton);

}  // namespace choreo::cli
