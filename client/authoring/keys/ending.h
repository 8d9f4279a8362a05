#pragma once

#include <string>
#include <vector>

#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/keys/pose_source.h"

namespace choreo::authoring {

/// Makes a key of a pose in which a dance comes to rest: on the last beat at least a second before
/// the end or, without beats, a second and a half before the end. `beats`: seconds. Throws
/// Error(kInvalidArgument) whose field is "--end" for a dance that is too short.
client::KeyPose Ending(const NamedPose& pose, const std::vector<double>& beats,
                       const DanceLength& length);

/// Notes (notes.h) that an ending holds the pose to the last frame if its file says otherwise.
void NoteOwnHold(const NamedPose& pose);

/// Adds the Ending of a pose, held to the last frame. A library pose faces the audience where the
/// dance's last key or path leads, or else in the middle of the stage. Removes later keys, and keys
/// less than kWayFromHold (key_file.h) before the pose. Returns the removed keys' ids, without keys
/// that only hold another. Throws as Ending does.
std::vector<std::string> EndIn(const NamedPose& pose, const std::vector<double>& beats,
                               const ControlRequest& controls, const DanceLength& length,
                               DanceKeys* keys);

}  // namespace choreo::authoring
