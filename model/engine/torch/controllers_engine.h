#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/controllers/checkpoint.h"
#include "model/engine/step_engine.h"
#include "model/motion/contacts.h"
#include "model/motion/facing_pose.h"

namespace choreo {

/// The controllers network (model/controllers) in slots. Slots step one after another, so a row's
/// bits cannot depend on its neighbours. It is deterministic: seed, candidate and temperature
/// change nothing, and it hears no music. Made by engines.h.
class ControllersEngine : public StepEngine {
 public:
  ControllersEngine(ModelInfo info, int slots, ControllersModel model);
  ~ControllersEngine() override;

  const ModelInfo& model() const override { return info_; }
  std::string device() const override { return "cpu"; }
  int slots() const override { return static_cast<int>(slots_.size()); }
  int free_slots() const override;
  int Admit(const TransitionSpec& spec) override;
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override;
  void Release(int slot) noexcept override;

 private:
  struct Slot;
  void StepSlot(const StepInput& in, StepOutput* out);

  ModelInfo info_;
  ControllersModel model_;
  std::vector<std::unique_ptr<Slot>> slots_;  // null: free
};

}  // namespace choreo
