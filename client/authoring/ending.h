#pragma once

#include <string>
#include <vector>

#include "client/authoring/dance_keys.h"
#include "client/authoring/pose_source.h"

namespace choreo::authoring {

/// A pose as the key in which a dance comes to rest: on the last beat that leaves a second, or a
/// second and a half before the end without beats. `beats`: seconds. Throws
/// Error(kInvalidArgument) whose field is "--end" for a dance that is too short.
client::KeyPose Ending(const NamedPose& pose, const std::vector<double>& beats,
                       const DanceLength& length);

/// Adds a pose in which a dance comes to rest (Ending), held to the last frame. A library pose
/// stands where the dance's last key or path leads, or else in the middle of the stage, and faces
/// the audience. Keys less than kWayFromHold (key_file.h) before it and later ones make way;
/// returns their ids, without those that only hold another. Throws as Ending.
std::vector<std::string> EndIn(const NamedPose& pose, const std::vector<double>& beats,
                               const ControlRequest& controls, const DanceLength& length,
                               DanceKeys* keys);

}  // namespace choreo::authoring
