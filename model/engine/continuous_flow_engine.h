#pragma once

#include <memory>
#include <optional>
#include <string>

#include "model/engine/plan_sampling.h"
#include "model/engine/slot_engine.h"

namespace choreo {

/// A transition whose plan is on its way, or made, and which of its frames is next.
struct SampledTransition {
  std::optional<PlanSampling> sampling;  ///< until the plan is made
  SampledPlan plan;
  int next = 0;

  SlotProgress progress() const {
    return {.frame = next,
            .frames = static_cast<int>(plan.poses.size()),
            .being_admitted = sampling.has_value()};
  }
};

/// The continuous flow in slots: a transition is sampled whole in the slices of its admission, and
/// its frames are handed out. Windows are sampled one after another, so a transition's bits depend
/// on nothing else. It hears beats, not sounds. Made by engines.h.
class ContinuousFlowEngine : public SlotEngine<SampledTransition> {
 public:
  ContinuousFlowEngine(ModelInfo info, std::string device, int slots,
                       std::shared_ptr<const FlowModelParts> parts,
                       std::shared_ptr<const FlowNetwork> network);

 protected:
  SampledTransition Begin(const TransitionSpec& spec, int slot) override;
  bool Continue(SampledTransition& transition) override;
  void StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) override;

 private:
  std::shared_ptr<const FlowModelParts> parts_;
  std::shared_ptr<const FlowNetwork> network_;
};

}  // namespace choreo
