#pragma once

#include <memory>
#include <string>

#include "model/engine/sampler.h"
#include "model/flow/flow_sampler.h"

namespace choreo {

/// Samples the continuous flow. A slice is one evaluation of its network, in rounds if energy is
/// requested; the last slice runs the plan's stages. Windows are sampled one after another, so a
/// transition's bits depend on nothing else. Its music input is beats, not sound. Made by
/// samplers.h.
class ContinuousFlowSampler : public Sampler {
 public:
  ContinuousFlowSampler(ModelInfo info, std::string device,
                        std::shared_ptr<const FlowModelParts> parts,
                        std::shared_ptr<const FlowNetwork> network);

  Slices<Plan> Begin(const ValidSpec& spec) override;

 private:
  std::shared_ptr<const FlowModelParts> parts_;
  std::shared_ptr<const FlowNetwork> network_;
};

}  // namespace choreo
