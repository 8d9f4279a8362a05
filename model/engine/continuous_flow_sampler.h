#pragma once

#include <memory>
#include <string>

#include "model/engine/sampler.h"
#include "model/flow/transition_sampler.h"

namespace choreo {

/// The continuous flow: a slice is an evaluation of its network, in rounds where energy is asked
/// for; the last one is the stages of the plan. Windows are sampled one after another, so a
/// transition's bits depend on nothing else. It hears beats, not sounds. Made by samplers.h.
class ContinuousFlowSampler : public Sampler {
 public:
  ContinuousFlowSampler(ModelInfo info, std::string device,
                        std::shared_ptr<const FlowModelParts> parts,
                        std::shared_ptr<const FlowNetwork> network);

 protected:
  std::unique_ptr<Sampling> BeginValid(const TransitionSpec& spec) override;

 private:
  std::shared_ptr<const FlowModelParts> parts_;
  std::shared_ptr<const FlowNetwork> network_;
};

}  // namespace choreo
