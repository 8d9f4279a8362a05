#pragma once

#include <vector>

#include "client/cli/dance_keys.h"
#include "model/motion/pose_faults.h"

namespace choreo::cli {

/// Keys that no body could dance, as warnings at their frames: "key \"leap\" (keys.json:
/// keyframes[2]): the body hangs 2 m above the floor; ..." (motion/pose_faults.h).
std::vector<client::Warning> KeyFaults(const DanceKeys& keys, double fps, const Skeleton& skeleton);

/// Throws Error(kInvalidArgument), whose field is the key's place, for one that bends a knee or an
/// elbow as no body does, naming joint, degrees and limit.
void RefuseBends(const DanceKeys& keys, const Skeleton& skeleton);

/// The same warnings of keys that stand in no file, by time.
std::vector<client::Warning> KeyFaults(const std::vector<client::KeyPose>& keys, double fps,
                                       const Skeleton& skeleton);

/// The same of one key that is set into a dance; `around` are the poses between which the dancer
/// gets there and away, by time, named as messages call them.
std::vector<client::Warning> KeyFaults(const client::KeyPose& key, double fps,
                                       const Skeleton& skeleton,
                                       const std::vector<TimedPose>& around);

}  // namespace choreo::cli
