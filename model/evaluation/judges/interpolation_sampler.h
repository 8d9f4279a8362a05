#pragma once

#include "model/plan/sampler.h"

namespace choreo {

/// The baseline of paper F's Table 2 as a sampler in the same pipeline (arrival, footwork).
/// Interpolates from the last history pose to the key, linearly for the root and spherically for
/// joints, or along the requested path. Without a target it holds its posture.
class InterpolationSampler : public Sampler {
 public:
  /// Copies from `model` everything on which requests depend.
  explicit InterpolationSampler(ModelInfo model);

  Slices<Plan> Sample(const ValidSpec& spec) override;
};

}  // namespace choreo
