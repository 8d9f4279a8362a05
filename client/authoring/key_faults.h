#pragma once

#include <string>
#include <vector>

#include "client/authoring/dance_keys.h"
#include "model/motion/pose_faults.h"

namespace choreo::authoring {

/// Warns, at their frames, of changed keys (ByTime), then of impossible keys: "key \"leap\"
/// (keys.json: keyframes[2]): the body hangs 2 m above the floor; ..." (motion/pose_faults.h).
std::vector<client::Warning> KeyFaults(const DanceKeys& keys, double fps, const Skeleton& skeleton);

/// Throws Error(kInvalidArgument), whose field is the key's place, for a key with an impossible
/// bend of a knee or an elbow, naming joint, degrees and limit.
void RefuseBends(const DanceKeys& keys, const Skeleton& skeleton);

/// Throws Error(kInvalidArgument) with this field for a key in the air that is held for longer than
/// a jump of its height lasts.
void RefuseHeldInAir(const client::KeyPose& key, double seconds, const std::string& field,
                     const Skeleton& skeleton);
/// The same for all keys that others hold; fields are "keys.json:keyframes[2].hold".
void RefuseHeldInAir(const DanceKeys& keys, double fps, const Skeleton& skeleton);

/// The warnings of KeyFaults for keys without a file, in order of time.
std::vector<client::Warning> KeyFaults(const std::vector<client::KeyPose>& keys, double fps,
                                       const Skeleton& skeleton);

/// The same for one key that is set into a dance; `around` are the poses before and after it, in
/// order of time, named as in messages.
std::vector<client::Warning> KeyFaults(const client::KeyPose& key, double fps,
                                       const Skeleton& skeleton,
                                       const std::vector<TimedPose>& around);

}  // namespace choreo::authoring
