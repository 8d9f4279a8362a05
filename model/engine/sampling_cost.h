#pragma once

#include <mutex>

namespace choreo {

class Sampler;

/// Samples a usual transition twice and discards it, so that one-time setup is done before the
/// first client and the sampler's seconds_a_frame() is known. Throws what the sampler throws.
void WarmUp(Sampler& sampler);

/// A frame's cost on one worker: from its sampler's warm-up, then from recent transitions.
/// Thread-safe.
class SamplingCost {
 public:
  /// 0: not measured.
  explicit SamplingCost(double seconds_a_frame);

  /// Records a transition.
  void Add(double seconds, int frames);

  /// The share of the worker's time that this many frames a second need; above 1 for more than it
  /// can make. 0 if unknown.
  double LoadOf(double frames_per_second) const;

 private:
  mutable std::mutex mutex_;  // guards the decaying sums below
  double seconds_, frames_;
};

}  // namespace choreo
