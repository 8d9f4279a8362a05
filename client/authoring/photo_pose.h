#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Poses that other programs found in a photo. A person who looks into the camera faces +Z; a foot
/// is on the floor. Errors are Error(kNotFound) for a file that cannot be opened, and
/// Error(kInvalidArgument) whose field is NAME:MEMBER, naming value and limit.
namespace choreo::authoring {

/// MediaPipe Pose's 33 world landmarks, JSON: a list of {"x", "y", "z", "visibility"}, metres, or
/// an object whose member landmarks, worldLandmarks, poseWorldLandmarks or pose_world_landmarks is
/// that list. Landmarks without visibility count as visible.
Pose ParseLandmarkPose(std::string_view text, const std::string& name, const Skeleton& skeleton);

/// The same from a file.
Pose ReadLandmarkPose(const std::filesystem::path& path, const Skeleton& skeleton);

/// An SMPL pose as estimators write it, with the camera's y down: JSON or npz with `pose`, `poses`,
/// `smpl_poses` or `thetas`, or with `global_orient` and `body_pose`: 24 axis-angle vectors or
/// rotation matrices in all, in lists of any depth. Of 23 body joints the hands may be missing, as
/// in SMPL-H and SMPL-X. Does not read pickles.
Pose ReadSmplPose(const std::filesystem::path& path, const Skeleton& skeleton);

}  // namespace choreo::authoring
