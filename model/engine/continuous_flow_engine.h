#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/flow/flow_sampler.h"
#include "model/motion/contacts.h"

namespace choreo {

/// The continuous flow in slots: a transition is sampled whole when it is admitted, and its frames
/// are handed out. Windows are sampled one after another, so a transition's bits depend on nothing
/// else. It hears beats, not sounds. Made by engines.h.
class ContinuousFlowEngine : public StepEngine {
 public:
  ContinuousFlowEngine(ModelInfo info, std::string device, int slots,
                       std::shared_ptr<const FlowModelParts> parts,
                       std::shared_ptr<const FlowNetwork> network);

  const ModelInfo& model() const override { return info_; }
  std::string device() const override { return device_; }
  int slots() const override { return static_cast<int>(slots_.size()); }
  int free_slots() const override;
  int Admit(const TransitionSpec& spec) override;
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override;
  void Release(int slot) noexcept override { slots_[static_cast<size_t>(slot)].reset(); }

 private:
  struct Slot {
    std::vector<Pose> poses;
    std::vector<Contacts> contacts;
    int next = 0;
  };
  /// The transition as the network has it.
  std::vector<Pose> Sample(const TransitionSpec& spec) const;

  ModelInfo info_;
  std::string device_;
  std::shared_ptr<const FlowModelParts> parts_;
  std::shared_ptr<const FlowNetwork> network_;
  std::vector<std::optional<Slot>> slots_;
};

}  // namespace choreo
