#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/engine/flow_tile.h"
#include "model/engine/slot_engine.h"
#include "model/engine/transition_window.h"
#include "model/flow/flow_config.h"

namespace choreo {

/// Paper F's flow in slots, whatever computes its tile. Made by engines.h.
class FlowEngine : public SlotEngine<TransitionWindow> {
 public:
  FlowEngine(ModelInfo info, FlowConfig config, std::string device, int slots,
             std::unique_ptr<FlowTile> tile);

  int batch() const override { return tile_->rows(); }

 protected:
  TransitionWindow Begin(const TransitionSpec& spec, int slot) override;
  void StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) override;

 private:
  void StepTile(std::span<const StepInput> in, std::span<StepOutput> out);

  FlowConfig config_;
  std::unique_ptr<FlowTile> tile_;
  std::vector<FlowRow> rows_;    // of one tile
  std::vector<float> features_;  // [rows of a tile, width]
};

}  // namespace choreo
