#pragma once

#include "model/plan/sampler.h"

namespace choreo {

/// The baseline of paper F's Table 2 as a model in the same pipeline (arrival, footwork): linear
/// for the root, spherical for joints, from the last history pose to the key, or on the requested
/// path. Without a target it holds its posture.
class InterpolationSampler : public Sampler {
 public:
  /// Resembles `model` in everything that a request depends on.
  explicit InterpolationSampler(ModelInfo model);

  Slices<Plan> Begin(const ValidSpec& spec) override;
};

}  // namespace choreo
