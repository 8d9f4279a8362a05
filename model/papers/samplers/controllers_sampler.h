#pragma once

#include "model/papers/networks/controllers_model.h"
#include "model/plan/sampler.h"

namespace choreo {

/// The controllers network (model/papers/networks): a slice is a frame. Deterministic: seed,
/// candidate and temperature change nothing. It has no music input. Made by paper_samplers.h.
class ControllersSampler : public Sampler {
 public:
  ControllersSampler(ModelInfo info, ControllersModel network);

  Slices<Plan> Begin(const ValidSpec& spec) override;

 private:
  ControllersModel network_;
};

}  // namespace choreo
