#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/choreo_client.h"

/// Keys of a key file (key_file.h) with poses in numbers: rotations and root_position, or as in
/// SMPL motion files. `value` is the key, `field` its name. Throw Error(kInvalidArgument) whose
/// field is FIELD.MEMBER.
namespace choreo::authoring {

bool HasNumbers(const nlohmann::json& value);
/// Throws if it has numbers besides `pose`.
void RefuseNumbers(const nlohmann::json& value, const std::string& field);
/// The pose under one of its three names; the mask says whether it fixes the dancer's place.
client::KeyPose ReadNumbers(const nlohmann::json& value, const std::string& field,
                            const Skeleton& skeleton);

}  // namespace choreo::authoring
