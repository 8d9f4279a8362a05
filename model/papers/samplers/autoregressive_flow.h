#pragma once

#include <functional>
#include <memory>
#include <string>

#include "model/engine/sampler.h"
#include "model/papers/networks/flow_config.h"
#include "model/papers/samplers/flow_tile.h"

namespace choreo {

/// Paper F's flow, whatever computes its tiles: a slice is a frame. Features are encoded anew from
/// the poses that arrival has steered, so a transition is a function of poses alone. Made by
/// paper_samplers.h.
class AutoregressiveFlowSampler : public Sampler {
 public:
  /// Makes a tile for one transition.
  using MakeTile = std::function<std::unique_ptr<FlowTile>()>;

  AutoregressiveFlowSampler(ModelInfo info, FlowConfig config, std::string device,
                            MakeTile make_tile);

 protected:
  std::unique_ptr<Sampling> BeginValid(const TransitionSpec& spec) override;

 private:
  FlowConfig config_;
  MakeTile make_tile_;
};

}  // namespace choreo
