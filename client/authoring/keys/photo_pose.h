#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Reads poses that other programs estimated from a photo. A person who looks into the camera faces
/// +Z, and a foot is on the floor. Functions throw Error(kNotFound) for a file that cannot be
/// opened, and Error(kInvalidArgument) whose field is NAME:MEMBER, naming value and limit.
namespace choreo::authoring {

/// Parses MediaPipe Pose's 33 world landmarks, JSON: a list of {"x", "y", "z", "visibility"},
/// metres, or an object whose member landmarks, worldLandmarks, poseWorldLandmarks or
/// pose_world_landmarks is that list. Landmarks without visibility count as visible.
Pose ParseLandmarkPose(std::string_view text, const std::string& name, const Skeleton& skeleton);

/// Reads a file for ParseLandmarkPose.
Pose ReadLandmarkPose(const std::filesystem::path& path, const Skeleton& skeleton);

/// Reads an SMPL pose as estimators write it, with the camera's y down. The file is JSON or npz
/// with `pose`, `poses`, `smpl_poses` or `thetas`, or with `global_orient` and `body_pose`: 24
/// axis-angle vectors or rotation matrices in all, in lists of any depth. The hands may be missing
/// from the 23 body joints, as in SMPL-H and SMPL-X. Does not read pickles.
Pose ReadSmplPose(const std::filesystem::path& path, const Skeleton& skeleton);

}  // namespace choreo::authoring
