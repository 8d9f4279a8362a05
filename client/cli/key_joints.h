#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/choreo_client.h"

/// Parts of a key file (key_file.h) that name poses and joints.
namespace choreo::cli {

/// `pose`, the name of one in the library, where `place` and `facing` put it. Throws
/// Error(kInvalidArgument) whose field is FIELD.pose, .place or .facing.
client::KeyPose ReadNamedPose(const nlohmann::json& value, const std::string& field,
                              const Skeleton& skeleton);

/// `joints` of the key `value`: a list of names limits the key's pose to these; an object turns
/// joints of `key`'s pose to degrees (motion/joint_angles.h). Throws Error(kInvalidArgument) whose
/// field is FIELD.joints, or FIELD.joints.NAME.
void ReadJoints(const nlohmann::json& joints, const std::string& field, const Skeleton& skeleton,
                client::KeyPose* key);

/// Limits a key to the joints that `joints`, an object of degrees, names.
void AskForNamed(const nlohmann::json& joints, const Skeleton& skeleton, client::KeyPose* key);

}  // namespace choreo::cli
