#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Finds what looks wrong in a finished motion, of bodies and physics alone. Pure functions. The
/// faults of keys before they are danced are in pose_faults.h.
namespace choreo {

/// A foot that moves faster than this over the floor, m/s, skates.
inline constexpr double kSkateSpeed = 0.2;

enum class MotionFaultKind : uint8_t { kArmInside, kFloating, kSliding, kUnderFloor, kSnap };

/// What a kind of fault measures, and the limit beyond which it is a fault.
struct MotionFaultRow {
  std::string_view name;   ///< in files
  std::string_view label;  ///< for people
  std::string_view unit;   ///< of `limit` and MotionFault::worst
  double limit = 0;
};

/// By MotionFaultKind. Decision 416 states the share of the frames of recordings that are beyond
/// these limits.
inline constexpr std::array<MotionFaultRow, 5> kMotionFaults = {{
    /// The least distance from the line through the spine to a forearm or a hand (TrunkLine).
    {"arm_inside", "arm inside the trunk", "m", 0.05},
    /// The height of the lowest point of a body that neither touches the floor nor falls freely.
    {"floating", "floating", "m", 0.1},
    /// How far a foot slides while ankle and toes are on the floor.
    {"sliding", "foot sliding", "m", 0.15},
    /// The depth of the deepest joint's skin under the floor.
    {"under_floor", "under the floor", "m", 0.05},
    /// The angular acceleration of a thigh, shin, upper arm or forearm: to turn by 60 degrees
    /// within a thirtieth of a second.
    {"snap", "snap", "rad/s2", 900},
}};

inline constexpr double LimitOf(MotionFaultKind kind) {
  return kMotionFaults[static_cast<size_t>(kind)].limit;
}

/// A stretch of frames, [first, last], with a fault.
struct MotionFault {
  MotionFaultKind kind = MotionFaultKind::kArmInside;
  int64_t first = 0, last = 0;
  int joint = 0;     ///< wrist, root, toes, deepest joint, or the lower end of the bone that snaps
  double worst = 0;  ///< in the unit of the kind's row

  const MotionFaultRow& row() const { return kMotionFaults[static_cast<size_t>(kind)]; }
  bool operator==(const MotionFault&) const = default;
};

/// The faults of a motion, in order of time. The floor is y = 0. An arm's, a depth's and a snap's
/// stretches that are less than 0.2 s apart count as one, and a body floats for 0.2 s at least.
/// Motions of other rates are measured at kModelFps. Skips kinds for which the skeleton lacks
/// joints.
std::vector<MotionFault> FindMotionFaults(const Skeleton& skeleton, const Motion& motion);

/// The same stretch in frames of another rate.
MotionFault AtRate(MotionFault fault, double from, double to);

/// Describes a fault: "left_wrist: the arm is 2 cm from the line of the spine".
std::string Describe(const Skeleton& skeleton, const MotionFault& fault);

/// Counts faults by kind: "3 faults: 2 foot sliding, 1 snap", or "no faults".
std::string CountMotionFaults(std::span<const MotionFault> faults);

/// The share of a motion's `frames` with a fault of this kind.
double FaultShare(std::span<const MotionFault> faults, MotionFaultKind kind, int64_t frames);

}  // namespace choreo
