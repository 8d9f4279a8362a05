#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/engine/step_engine.h"
#include "model/engine/torch_tile.h"
#include "model/engine/transition_window.h"

namespace choreo {

/// The flow model, stepped by LibTorch; made by torch_engine.h. Rows go through a tile of fixed
/// size, so a row's bits depend neither on its slot nor on who steps with it.
class TorchStepEngine : public StepEngine {
 public:
  TorchStepEngine(std::shared_ptr<TorchWeights> weights, ModelInfo info, std::string device,
                  int slots, int tile_rows);

  const ModelInfo& model() const override { return info_; }
  std::string device() const override { return device_; }
  int slots() const override { return static_cast<int>(slots_.size()); }
  int free_slots() const override;
  int Admit(const TransitionSpec& spec) override;
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override;
  void Release(int slot) noexcept override { slots_[static_cast<size_t>(slot)].taken = false; }

 private:
  struct Slot {
    explicit Slot(const ModelInfo& model) : window(model) {}
    bool taken = false;
    TransitionWindow window;
    torch::Tensor static_condition;  // [N, static_width], on the CPU
  };
  std::vector<Pose> Plan(const TransitionSpec& spec, Slot* slot) const;
  void StepTile(std::span<const StepInput> in, std::span<StepOutput> out);

  std::shared_ptr<TorchWeights> weights_;
  ModelInfo info_;
  std::string device_;
  std::vector<Slot> slots_;
  TorchTile tile_;
  torch::Tensor states_;  // [slots, StateWidth()], on the device
};

}  // namespace choreo
