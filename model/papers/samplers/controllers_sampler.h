#pragma once

#include "model/papers/networks/controllers_model.h"
#include "model/plan/sampler.h"

namespace choreo {

/// Samples the controllers network (model/papers/networks); a slice is a frame. Deterministic:
/// seed, candidate and temperature change nothing. Ignores music. Made by paper_samplers.h.
class ControllersSampler : public Sampler {
 public:
  ControllersSampler(ModelInfo info, ControllersModel network);

  Slices<Plan> Sample(const ValidSpec& spec) override;

 private:
  ControllersModel network_;
};

}  // namespace choreo
