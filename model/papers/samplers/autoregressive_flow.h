#pragma once

#include <functional>
#include <memory>
#include <string>

#include "model/papers/networks/flow_config.h"
#include "model/papers/samplers/flow_stepper.h"
#include "model/plan/sampler.h"

namespace choreo {

/// Samples paper F's flow with any stepper; a slice is a frame. Encodes features again from poses
/// after arrival, so a transition depends only on poses. Made by paper_samplers.h.
class AutoregressiveFlowSampler : public Sampler {
 public:
  /// Makes a stepper for one transition.
  using MakeStepper = std::function<std::unique_ptr<FlowStepper>()>;

  AutoregressiveFlowSampler(ModelInfo info, FlowConfig config, std::string device,
                            MakeStepper make_stepper);

  Slices<Plan> Sample(const ValidSpec& spec) override;

 private:
  FlowConfig config_;
  MakeStepper make_stepper_;
};

}  // namespace choreo
