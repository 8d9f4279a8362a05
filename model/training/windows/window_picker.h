#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/numbers/random.h"

namespace choreo {

/// Draws the places of windows in clips, all equally likely.
class WindowPicker {
 public:
  /// `clips`: frames of each. One more frame precedes a window, for its first velocity. Throws
  /// Error(kInvalidArgument, "frames") if no clip is long enough.
  WindowPicker(std::span<const int64_t> clips, int64_t window) {
    int64_t windows = 0;
    for (const int64_t frames : clips) {
      windows += std::max<int64_t>(0, frames - window);
      ends_.push_back(windows);
    }
    if (windows == 0) {
      throw InvalidArgument("frames", "no clip has the " + std::to_string(window + 1) +
                                          " frames that a window needs");
    }
  }

  struct Place {
    size_t clip;
    int64_t start;  ///< at least 1
  };
  Place Draw(Random* random) const {
    const int64_t pick = random->Integer(0, ends_.back());
    const auto clip = std::ranges::upper_bound(ends_, pick) - ends_.begin();
    return {static_cast<size_t>(clip), pick - (clip > 0 ? ends_[clip - 1] : 0) + 1};
  }

 private:
  std::vector<int64_t> ends_;  // running count of the windows in each clip
};

}  // namespace choreo
