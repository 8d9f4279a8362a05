#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/engine/slot_engine.h"
#include "model/flow/flow_sampler.h"
#include "model/motion/contacts.h"

namespace choreo {

/// A transition that is made, and which of its frames is next.
struct SampledTransition {
  std::vector<Pose> poses;
  std::vector<Contacts> contacts;
  int next = 0;

  SlotProgress progress() const { return {next, static_cast<int>(poses.size()), false}; }
};

/// The continuous flow in slots: a transition is sampled whole when it is admitted, and its frames
/// are handed out. Windows are sampled one after another, so a transition's bits depend on nothing
/// else. It hears beats, not sounds. Made by engines.h.
class ContinuousFlowEngine : public SlotEngine<SampledTransition> {
 public:
  ContinuousFlowEngine(ModelInfo info, std::string device, int slots,
                       std::shared_ptr<const FlowModelParts> parts,
                       std::shared_ptr<const FlowNetwork> network);

 protected:
  SampledTransition Begin(const TransitionSpec& spec, int slot) override;
  void StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) override;

 private:
  /// The transition as the network has it.
  std::vector<Pose> Sample(const TransitionSpec& spec) const;

  std::shared_ptr<const FlowModelParts> parts_;
  std::shared_ptr<const FlowNetwork> network_;
};

}  // namespace choreo
