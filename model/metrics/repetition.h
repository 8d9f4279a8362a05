#pragma once

#include <span>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// What long synthesis is prone to (paper C, Section 4.2, Figure 10: "repeated meaningless actions"
/// beyond 200 frames), by comparing a motion with its own past. Shares of its windows of half a
/// second, 0 to 1; real dance has its own, to compare with.
struct Repetition {
  /// Windows that hold still: no joint, seen from the root, is faster than 0.15 m/s on average over
  /// the window.
  double frozen = 0;
  /// Windows that move and look as one before them did that began a second earlier or more: joints
  /// on average less than 5 cm apart, each pose seen from its own place on the floor and heading.
  double repeated = 0;
};

/// Of all windows, or of those alone that begin at frame `from` or later (an ending; what stands
/// before it is the past that it may repeat). Throws Error(kInvalidArgument) where no window begins
/// there. Moving or turning the scene changes nothing. Pure, thread-safe.
Repetition MeasureRepetition(const Skeleton& skeleton, std::span<const Pose> poses, double fps,
                             int from = 0);

}  // namespace choreo
