#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/choreo_client.h"

/// Poses and joints in key files (key_file.h).
namespace choreo::authoring {

/// `pose`, a library pose by name, moved to `place` and `facing`. Throws Error(kInvalidArgument)
/// whose field is FIELD.pose, .place or .facing.
client::KeyPose ReadNamedPose(const nlohmann::json& value, const std::string& field,
                              const Skeleton& skeleton);

/// `joints` of the key `value`: a list of names limits the key's pose to these; an object sets
/// joints of `key`'s pose in degrees (motion/joint_angles.h). Throws Error(kInvalidArgument) whose
/// field is FIELD.joints, or FIELD.joints.NAME.
void ReadJoints(const nlohmann::json& joints, const std::string& field, const Skeleton& skeleton,
                client::KeyPose* key);

/// Limits a key to the joints named in `joints`, an object of degrees.
void LimitToNamed(const nlohmann::json& joints, const Skeleton& skeleton, client::KeyPose* key);

}  // namespace choreo::authoring
