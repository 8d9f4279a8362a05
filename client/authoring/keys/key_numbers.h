#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/choreo_client.h"

/// Reads keys of a key file (key_file.h) whose poses are given in numbers: as rotations and
/// root_position, or as in SMPL motion files. `value` is the key, `field` its name. Functions throw
/// Error(kInvalidArgument) whose field is FIELD.MEMBER.
namespace choreo::authoring {

bool HasNumbers(const nlohmann::json& value);
/// Throws for a key that has numbers besides `pose`.
void RefuseNumbers(const nlohmann::json& value, const std::string& field);
/// Reads the pose, under any of its three names. The mask states whether the key fixes the dancer's
/// place.
client::KeyPose ReadNumbers(const nlohmann::json& value, const std::string& field,
                            const Skeleton& skeleton);

}  // namespace choreo::authoring
