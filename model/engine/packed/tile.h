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
  /// Floats of a tile's rows, one row after another.
  struct Buffer {
    Buffer() = default;
    explicit Buffer(long width) : stride(width), pages(static_cast<size_t>(kRows * width)) {}
    float* Row(long row) { return pages.data() + row * stride; }
    long stride = 0;
    LargePages pages;
  };

  void Hoist(Slot* slot, long frame);
  void Condition(std::span<const FlowRow> rows);
  void Couple(std::span<FlowRow> rows, int step);
  void Hidden(std::span<const FlowRow> rows, int step);

  std::shared_ptr<const PackedFlow> flow_;
  std::vector<Slot> slots_;
  Buffer live_;      // past and music, standardised
  Buffer encoding_;  // behind the encoding's first layer
  Buffer input_;     // of a coupling: condition, z_lo, own hidden state
  Buffer wide_;      // gates, or the first hidden layer
  Buffer hidden_;    // of the last layer; recurrent: [h0 | h1] before
  Buffer ab_;
  Buffer z_, mixed_;
};

}  // namespace choreo
