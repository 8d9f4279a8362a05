#pragma once

#include <mutex>

namespace choreo {

class Sampler;

/// Samples a typical transition twice and discards it. This completes one-time setup before the
/// first client, and measures the sampler's seconds_a_frame(). Throws what the sampler throws.
void WarmUp(Sampler& sampler);

/// The cost of a frame on one worker, measured in its sampler's warm-up and then in recent
/// transitions. A mean that includes takes and rounds of requested energy: a transition costs at
/// most kMaxTakes times as much as one sampling (plan/takes.h). Thread-safe.
class SamplingCost {
 public:
  /// `seconds_a_frame`: the initial cost; 0: not measured.
  explicit SamplingCost(double seconds_a_frame);

  /// Records a transition's cost.
  void Add(double seconds, int frames);

  /// The share of the worker's time that `frames_per_second` need; above 1 if the worker is too
  /// slow. 0 if unknown.
  double LoadOf(double frames_per_second) const;

 private:
  mutable std::mutex mutex_;  // guards the decaying sums below
  double seconds_, frames_;
};

}  // namespace choreo
