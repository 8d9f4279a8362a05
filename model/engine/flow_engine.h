#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/engine/flow_tile.h"
#include "model/engine/step_engine.h"
#include "model/engine/transition_window.h"
#include "model/flow/flow_config.h"

namespace choreo {

/// Paper F's flow in slots, whatever computes its tile. Made by engines.h.
class FlowEngine : public StepEngine {
 public:
  FlowEngine(ModelInfo info, FlowConfig config, std::string device, int slots,
             std::unique_ptr<FlowTile> tile);

  const ModelInfo& model() const override { return info_; }
  std::string device() const override { return device_; }
  int slots() const override { return static_cast<int>(slots_.size()); }
  int free_slots() const override;
  int batch() const override { return tile_->rows(); }
  int Admit(const TransitionSpec& spec) override;
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override;
  void Release(int slot) noexcept override { slots_[static_cast<size_t>(slot)].taken = false; }

 private:
  struct Slot {
    explicit Slot(const ModelInfo& model) : window(model) {}
    bool taken = false;
    TransitionWindow window;
  };
  Slot& At(const StepInput& input) { return slots_[static_cast<size_t>(input.slot)]; }
  void StepTile(std::span<const StepInput> in, std::span<StepOutput> out);

  ModelInfo info_;
  FlowConfig config_;
  std::string device_;
  std::vector<Slot> slots_;
  std::unique_ptr<FlowTile> tile_;
  std::vector<FlowRow> rows_;    // of one tile
  std::vector<float> features_;  // [rows of a tile, width]
};

}  // namespace choreo
