#pragma once

#include <torch/types.h>

#include <memory>
#include <vector>

#include "model/engine/flow_tile.h"
#include "model/flow/flow_model.h"

namespace choreo {

/// Weights on one device, shared by the engines there. Read only.
struct TorchWeights {
  FlowModel model{nullptr};  ///< in eval mode
  std::vector<torch::Tensor> inverse_weights;
  torch::Device device{torch::kCPU};
};

/// The flow, stepped by LibTorch: a fixed number of rows together, padded, with inputs and outputs
/// in host memory. The reference that faster tiles are held to.
class TorchTile : public FlowTile {
 public:
  TorchTile(std::shared_ptr<TorchWeights> weights, int rows, int slots);

  /// The largest of the usual tile sizes whose rows' bits depend neither on their place nor on
  /// their neighbours; 1 at worst.
  static int VerifiedRows(const std::shared_ptr<TorchWeights>& weights);

  int rows() const override { return rows_; }
  void Begin(int slot, std::vector<float> static_condition) override;
  void Run(std::span<FlowRow> rows) override;

 private:
  enum Input { kPast, kAudio, kHasAudio, kCondition, kNoise, kInputs };
  float* Row(Input input, size_t row) {
    return host_[input].data_ptr<float>() + static_cast<int64_t>(row) * host_[input].stride(0);
  }
  /// Steps every row of the inputs. `state` [rows, StateWidth()], on the device, is replaced.
  void Compute(FlowState* state);
  bool RowsAreIndependent();

  std::shared_ptr<TorchWeights> weights_;
  int rows_;
  torch::Tensor states_;                               ///< [slots, StateWidth()], on the device
  std::vector<std::vector<float>> static_conditions_;  ///< of the slots
  torch::Tensor host_[kInputs];                        ///< [rows, ...], pinned for CUDA
  torch::Tensor features_;                             ///< [rows, width], on the CPU
  torch::Tensor log_likelihood_;                       ///< [rows], on the CPU
};

}  // namespace choreo
