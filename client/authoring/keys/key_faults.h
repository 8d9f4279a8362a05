#pragma once

#include <string>
#include <vector>

#include "client/authoring/keys/dance_keys.h"
#include "model/motion/pose/pose_faults.h"

namespace choreo::authoring {

/// Returns warnings, with frames, about keys that ByTime changed, then about impossible keys: "key
/// \"leap\" (keys.json: keyframes[2]): the body hangs 2 m above the floor; ..."
/// (motion/pose/pose_faults.h).
std::vector<client::Warning> KeyFaults(const DanceKeys& keys, double fps, const Skeleton& skeleton);

/// Throws Error(kInvalidArgument), whose field is the key's place, for a key with an impossible
/// bend of a knee or an elbow. The message names joint, degrees and limit.
void RefuseBends(const DanceKeys& keys, const Skeleton& skeleton);

/// Throws Error(kInvalidArgument, field) for a key in the air that is held for longer than a jump
/// of its height lasts.
void RefuseHeldInAir(const client::KeyPose& key, double seconds, const std::string& field,
                     const Skeleton& skeleton);
/// The same for all of these keys. The field is like "keys.json:keyframes[2].hold".
void RefuseHeldInAir(const DanceKeys& keys, double fps, const Skeleton& skeleton);

/// Returns the warnings about impossible keys, for keys without a file, in order of time.
std::vector<client::Warning> KeyFaults(const std::vector<client::KeyPose>& keys, double fps,
                                       const Skeleton& skeleton);

/// Returns the warnings about a key set in a dance. `held_to`: the last frame of its hold, or its
/// own frame. `around`: the poses before and after, in order of time, with their names in messages.
std::vector<client::Warning> KeyFaults(const client::KeyPose& key, int64_t held_to, double fps,
                                       const Skeleton& skeleton,
                                       const std::vector<TimedPose>& around);

}  // namespace choreo::authoring
