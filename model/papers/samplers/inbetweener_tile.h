#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/papers/networks/inbetweener.h"
#include "model/papers/samplers/flow_tile.h"

namespace choreo {

/// The baseline without a flow, stepped by LibTorch on the CPU in the place of one: row by row, so
/// that no row's bits depend on others. It draws no noise and has no likelihood.
class InbetweenerTile : public FlowTile {
 public:
  /// `model`: in eval mode.
  InbetweenerTile(Inbetweener model, int slots);

  void Begin(int slot, Eigen::MatrixXf conditions) override;
  void Run(std::span<FlowRow> rows) override;

 private:
  struct Slot {
    Eigen::MatrixXf conditions;
    LstmState state;
  };

  Inbetweener model_;
  std::vector<Slot> slots_;
};

}  // namespace choreo
