#pragma once

#include <span>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// The faults of long synthesis (paper C, Section 4.2, Figure 10: "repeated meaningless actions"
/// beyond 200 frames), found by comparing a motion with its own past. Shares of half-second
/// windows, 0 to 1. Compare them with real dance's.
struct Repetition {
  /// Windows that hold still: no joint moves faster than 0.15 m/s relative to the root, averaged
  /// over the window.
  double frozen = 0;
  /// Windows that move and look like a window at least a second earlier: joints are on average less
  /// than 5 cm apart, each pose relative to its own floor position and heading.
  double repeated = 0;
};

/// Measures the windows that begin at frame `from` or later; they may repeat earlier frames, too.
/// Throws Error(kInvalidArgument) if no window begins there. Moving or turning the scene changes
/// nothing. Pure, thread-safe.
Repetition MeasureRepetition(const Skeleton& skeleton, std::span<const Pose> poses, double fps,
                             int from = 0);

}  // namespace choreo
