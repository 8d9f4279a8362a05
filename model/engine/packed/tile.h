#pragma once

#include <memory>
#include <vector>

#include "model/engine/flow_tile.h"
#include "model/engine/packed/flow.h"

namespace choreo {

/// The flow on the CPU that calls it, on one thread. Any number of rows costs what it is: nothing
/// is padded. A step allocates nothing.
///
/// What is known before the loop is computed ahead, in one product over kAhead frames: when a
/// transition starts, and again each time that many frames have been made, so that long transitions
/// neither take long to start nor much memory.
class PackedTile : public FlowTile {
 public:
  PackedTile(std::shared_ptr<const PackedFlow> flow, int slots);

  int rows() const override { return kRows; }
  void Begin(int slot, Eigen::MatrixXf conditions) override;
  void Run(std::span<FlowRow> rows) override;

 private:
  static constexpr int kRows = 64;
  static constexpr long kAhead = 16;

  struct Slot {
    std::vector<float> static_condition;  // [N, static_width]
    std::vector<float>
        hoisted;  // [kAhead, hoisted_width], of frames from `hoisted_from`; encoded: none
    long hoisted_from = 0;
    std::vector<float> state;  // [flow_steps, h0 h1 c0 c1, hidden]
  };

  void Hoist(Slot* slot, long frame);
  void Condition(std::span<const FlowRow> rows);
  void Couple(std::span<FlowRow> rows, int step);
  void Hidden(std::span<const FlowRow> rows, int step);

  std::shared_ptr<const PackedFlow> flow_;
  std::vector<Slot> slots_;
  RowBuffer live_;      // past and music, standardised
  RowBuffer encoding_;  // behind the encoding's first layer
  RowBuffer input_;     // of a coupling: condition, z_lo, own hidden state
  RowBuffer wide_;      // gates
  RowBuffer hidden_;    // of the last layer; [h0 | h1] before
  RowBuffer ab_;
  RowBuffer z_, mixed_;
};

}  // namespace choreo
