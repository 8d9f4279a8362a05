#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Finds poses that no body can take and describes them for users. Pure functions, which throw
/// Error(kInvalidArgument) for a pose or mask of another joint count.
namespace choreo {

inline constexpr double kMaxJumpHeight = 1.2;  ///< metres from the floor to the feet
/// Metres above the floor from which a body is in the air. Less may be tiptoe.
inline constexpr double kInAir = 0.15;

/// The faults of one pose within `mask`: "left_foot is 12 cm under the floor", "the body hangs 1.5
/// m above the floor", "right_knee bends 40 degrees backwards, further than 15".
std::vector<std::string> PoseFaults(const Skeleton& skeleton, const Pose& pose,
                                    const PoseMask& mask = {});

/// The faults of knees and elbows alone: bent backwards or folded farther than any body bends.
std::vector<std::string> BendFaults(const Skeleton& skeleton, const Pose& pose,
                                    const PoseMask& mask = {});

/// The fault of a pose in the air that is held for longer than a jump to its height lasts: "the
/// body is 0.25 m in the air, where a jump keeps it for 0.45 s, not 1 s"; empty if there is none.
std::string HoldFault(const Skeleton& skeleton, const Pose& pose, const PoseMask& mask,
                      double seconds);

/// A key's pose and its time.
struct TimedPose {
  std::string name;
  double seconds = 0;
  Pose pose;
  PoseMask mask = {};
  std::optional<double> hit = {};  ///< how hard it is hit, 0 to kMaxHit
};

/// A fault of one of several poses.
struct TimedFault {
  size_t pose = 0;      ///< the pose's index
  bool on_way = false;  ///< on the way from the pose before, rather than over several poses
  std::string message;
};

/// Finds faults between poses in time: limbs that would move too fast ("left_hand would go 9.3 m/s
/// about the body from "a" to "b"; people reach 7"), a pelvis that would go to the floor or rise
/// from it too fast, a hit without time for it, and a body in the air for longer than a jump lasts.
/// The time before the first pose starts at second 0, standing. The server warns about each pose's
/// own faults and about bodies that travel too fast.
std::vector<TimedFault> DanceFaults(const Skeleton& skeleton, const std::vector<TimedPose>& poses);

}  // namespace choreo
