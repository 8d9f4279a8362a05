#pragma once

#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// What no body does, though a pose may say so; in words for people. Pure functions, which throw
/// Error(kInvalidArgument) for a pose or mask of another joint count.
namespace choreo {

inline constexpr double kHighestJump = 1.2;  ///< metres that feet are above the floor

/// Of one pose, as far as `mask` asks for it: "left_foot is 12 cm under the floor", "the body hangs
/// 1.5 m above the floor", "right_knee bends 40 degrees backwards, further than 15".
std::vector<std::string> PoseFaults(const Skeleton& skeleton, const Pose& pose,
                                    const PoseMask& mask = {});

/// Those of its knees and elbows alone.
std::vector<std::string> BendFaults(const Skeleton& skeleton, const Pose& pose,
                                    const PoseMask& mask = {});

/// A pose that is asked for at a moment.
struct TimedPose {
  std::string name;
  double seconds = 0;
  Pose pose;
  PoseMask mask = {};
};

/// What is wrong with one of them.
struct TimedFault {
  size_t pose = 0;  ///< its index
  std::string message;
};

/// Of poses in time, by time: the faults of each; limbs that would be too fast ("left_hand would go
/// 9.3 m/s about the body from "a" to "b"; people reach 7"); and a body that is in the air for
/// longer than a jump takes. Of a body that travels too fast the server tells.
std::vector<TimedFault> DanceFaults(const Skeleton& skeleton, const std::vector<TimedPose>& poses);

}  // namespace choreo
