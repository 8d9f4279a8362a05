#pragma once

#include <torch/types.h>

#include <memory>
#include <vector>

#include "model/papers/networks/flow_model.h"
#include "model/papers/samplers/flow_tile.h"

namespace choreo {

/// Weights on one device, shared by the engines there. Read only.
struct TorchWeights {
  FlowModel model{nullptr};  ///< in eval mode
  std::vector<torch::Tensor> inverse_weights;
  torch::Device device{torch::kCPU};
};

/// The flow, stepped by LibTorch: a row for each slot, padded, with inputs and outputs in host
/// memory. The reference that faster tiles are held to, and the one that runs on CUDA.
class TorchTile : public FlowTile {
 public:
  TorchTile(std::shared_ptr<TorchWeights> weights, int slots);

  void Begin(int slot, Eigen::MatrixXf conditions) override;
  void Run(std::span<FlowRow> rows) override;

 private:
  /// Columns of the input.
  enum Part { kPast, kAudio, kHasAudio, kCondition, kNoise, kUnderWay, kParts };
  std::span<float> Row(Part part, size_t row);
  torch::Tensor Input(Part part) const;
  /// Everything that the device does in a step.
  void Compute();

  std::shared_ptr<TorchWeights> weights_;
  /// With one row more that nobody needs: LibTorch computes the last elements of a tensor one by
  /// one and the others as vectors, which now and then round otherwise.
  int padded_;
  int spare_;                                          ///< the slot of rows that nobody needs
  std::vector<std::vector<float>> static_conditions_;  ///< of the slots
  int64_t begin_[kParts + 1];                          ///< of each part, in columns

  // What a step reads and writes, here (pinned for CUDA) and on the device; the same on the CPU.
  torch::Tensor host_input_, input_;  ///< [padded, begin_[kParts]]
  torch::Tensor host_slots_, slots_;  ///< [padded], of int64
  torch::Tensor host_output_;         ///< [padded, width + 1]: features, log-likelihood
  torch::Tensor states_;              ///< [slots + 1, StateWidth()], on the device
};

}  // namespace choreo
