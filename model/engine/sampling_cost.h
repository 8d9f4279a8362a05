#pragma once

#include <mutex>

namespace choreo {

class Sampler;

/// Samples a usual transition twice and forgets it: whatever is set up when it is first used is
/// there when the first client comes, and the sampler's seconds_a_frame() are known. Throws what
/// the sampler throws.
void WarmUp(Sampler& sampler);

/// What a frame costs one worker: what the warm-up of its sampler measured, then what transitions
/// have taken lately. Thread-safe.
class SamplingCost {
 public:
  /// 0: nothing was measured.
  explicit SamplingCost(double seconds_a_frame);

  /// A transition is made.
  void Add(double seconds, int frames);

  /// The share of the worker's time that so many frames a second take, above 1 where they are more
  /// than it can make. 0 where nothing is known.
  double LoadOf(double frames_per_second) const;

 private:
  mutable std::mutex mutex_;  // guards all below; sums in which what is old fades
  double seconds_, frames_;
};

}  // namespace choreo
