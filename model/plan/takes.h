#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "model/core/limits.h"

/// Samples motion again that no dancer would dance, with other noise, and keeps the take with the
/// least excess. The flow's sampler repeats windows, because its network may leave human postures.
/// TransitionRun repeats whole transitions, because beats, arrival and footwork change speeds. Each
/// is sampled at most kMaxTakes times. Takes nest, and rounds of requested energy nest in them, so
/// one budget bounds all: a transition samples at most kMaxTakes times its frames.
namespace choreo {

inline constexpr int kMaxTakes = 5;
/// The distance between the numbers of a transition's takes, which leaves room for its windows'.
inline constexpr int kTransitionTake = 2048;

/// The candidate whose noise take number `take` of a candidate uses; 0 is the candidate's own. No
/// other candidate of a transition, and no other take, has this number.
inline uint32_t CandidateOfTake(uint32_t candidate, int take) {
  return candidate + static_cast<uint32_t>(kMaxCandidates) * static_cast<uint32_t>(take);
}

/// The frames that a transition may still sample beside the first sampling of each.
class SpareFrames {
 public:
  explicit SpareFrames(int left) : left_(left) {}
  /// The budget of a transition of `frames` frames.
  static SpareFrames Of(int frames) { return SpareFrames((kMaxTakes - 1) * frames); }

  int left() const { return left_; }
  /// Spends these frames for sampling number `number` of them, if they are left; the first, number
  /// 0, costs nothing.
  [[nodiscard]] bool SpendUnlessFirst(int number, int frames) {
    const int cost = number == 0 ? 0 : frames;
    if (cost > left_) return false;
    left_ -= cost;
    return true;
  }
  /// Takes frames that have been sampled already, down to none left.
  void Charge(int frames) { left_ = std::max(0, left_ - frames); }

 private:
  int left_;
};

/// The best of several takes. Not thread-safe.
template <typename Motion>
class BestTake {
 public:
  /// The number of takes so far, which is the next one's number.
  int takes() const { return takes_; }
  /// Whether another take is worth its frames: none is within the limits so far, and takes are
  /// left.
  bool WantsAnother() const { return takes_ == 0 || (excess_ > 1 && takes_ < kMaxTakes); }
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
