#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/core/numbers/random.h"

namespace choreo {

/// The random numbers of a transition, and how far they count.
struct TransitionNoise {
  uint64_t seed = 0;
  uint32_t candidate = 0;
  int64_t first_frame = 0;  ///< absolute number of frame 0
  /// For each frame, the absolute frame whose numbers it repeats with `variation`, 0 to 1
  /// (FillNormalLike). [frames], or empty: all frames have their own.
  std::vector<int64_t> noise_like = {};
  double variation = 0;
  double temperature = 0.3F;  ///< 0: the model's mean motion, whatever the numbers

  /// The numbers of a frame, counted from frame 0: they depend on seed, candidate, absolute frame
  /// and position in `out`.
  void FillNoise(int frame, std::span<float> out) const {
    const int64_t own = first_frame + frame;
    const int64_t like = noise_like.empty() ? own : noise_like[static_cast<size_t>(frame)];
    FillNormalLike(seed, candidate, own, like, variation, out);
  }
};

}  // namespace choreo
