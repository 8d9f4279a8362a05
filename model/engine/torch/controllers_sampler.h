#pragma once

#include "model/controllers/controllers_model.h"
#include "model/engine/sampler.h"

namespace choreo {

/// The controllers network (model/controllers): a slice is a frame. It is deterministic: seed,
/// candidate and temperature change nothing, and it hears no music. Made by samplers.h.
class ControllersSampler : public Sampler {
 public:
  ControllersSampler(ModelInfo info, ControllersModel network);

 protected:
  std::unique_ptr<Sampling> BeginValid(const TransitionSpec& spec) override;

 private:
  ControllersModel network_;
};

}  // namespace choreo
