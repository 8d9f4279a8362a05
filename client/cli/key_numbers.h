#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "client/choreo_client.h"

/// Keys of a key file (key_file.h) whose poses are numbers: rotations and root_position, or as
/// SMPL's motion files have them. `value` is the key, `field` its name. Throw
/// Error(kInvalidArgument) whose field is FIELD.MEMBER.
namespace choreo::cli {

bool HasNumbers(const nlohmann::json& value);
/// Throws where it has numbers, beside `pose`.
void RefuseNumbers(const nlohmann::json& value, const std::string& field);
/// The pose under one of its three names; the mask says whether it tells where the dancer is.
client::KeyPose ReadNumbers(const nlohmann::json& value, const std::string& field,
                            const Skeleton& skeleton);

}  // namespace choreo::cli
