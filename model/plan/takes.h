#pragma once

#include <cstdint>
#include <utility>

#include "model/core/limits.h"

/// How motion that no dancer would dance is sampled again: a window by the flow's sampler, whose
/// network may leave human postures, and a whole transition by TransitionRun, since beats, arrival
/// and footwork change speeds. Each is sampled at most kMaxTakes times, with noise of its own, and
/// the take with the least excess is kept. Takes nest, so a window is sampled up to kMaxTakes²
/// times, and that again in each round of requested energy.
namespace choreo {

inline constexpr int kMaxTakes = 5;
/// The distance between the numbers of a transition's takes, which leaves room for its windows'.
inline constexpr int kTransitionTake = 2048;

/// The candidate whose noise take number `take` of a candidate uses; 0 is the candidate's own. No
/// other candidate of a transition, and no other take, has this number.
inline uint32_t CandidateOfTake(uint32_t candidate, int take) {
  return candidate + static_cast<uint32_t>(kMaxCandidates) * static_cast<uint32_t>(take);
}

/// The best of several takes. Not thread-safe.
template <typename Motion>
class BestTake {
 public:
  /// The number of takes so far, which is the next one's number.
  int takes() const { return takes_; }
  /// Whether to sample another one: none is within the limits so far, and takes are left.
  bool NeedsAnother() const { return takes_ == 0 || (excess_ > 1 && takes_ < kMaxTakes); }
  /// `excess`: the take's largest ratio to a limit of what dancers do; at most 1 is within it.
  void Add(Motion motion, double excess) {
    if (takes_++ > 0 && !(excess < excess_)) return;
    motion_ = std::move(motion);
    excess_ = excess;
  }
  /// The take with the least excess, the first of equals.
  const Motion& motion() const { return motion_; }

 private:
  Motion motion_ = {};
  double excess_ = 0;
  int takes_ = 0;
};

}  // namespace choreo
