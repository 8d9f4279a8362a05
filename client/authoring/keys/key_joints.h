#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/choreo_client.h"

/// Reads poses and joints of key files (key_file.h).
namespace choreo::authoring {

/// Reads the member `pose`, the name of a library pose, and moves the pose to `place` and `facing`.
/// Throws Error(kInvalidArgument) whose field is FIELD.pose, .place or .facing.
client::KeyPose ReadNamedPose(const nlohmann::json& value, const std::string& field,
                              const Skeleton& skeleton);

/// Reads the member `joints` of a key. A list of names limits the key's pose to these joints. An
/// object sets joints of the key's pose in degrees (motion/kinematics/joint_angles.h). Throws
/// Error(kInvalidArgument) whose field is FIELD.joints, or FIELD.joints.NAME.
void ReadJoints(const nlohmann::json& joints, const std::string& field, const Skeleton& skeleton,
                client::KeyPose* key);

/// Limits a key to the joints named in its member `joints`, an object of degrees, and to its
/// `place` and `facing`, if any.
void LimitToNamed(const nlohmann::json& value, const Skeleton& skeleton, client::KeyPose* key);

}  // namespace choreo::authoring
