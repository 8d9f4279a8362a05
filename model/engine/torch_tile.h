#pragma once

#include <torch/types.h>

#include <memory>
#include <vector>

#include "model/flow/flow_model.h"

namespace choreo {

/// Weights on one device, shared by the engines there. Read only.
struct TorchWeights {
  FlowModel model{nullptr};  ///< in eval mode
  std::vector<torch::Tensor> inverse_weights;
  torch::Device device{torch::kCPU};
};

/// A fixed number of rows that the flow steps together, with its inputs and outputs in host memory.
/// All calls under c10::InferenceMode. Not thread-safe.
class TorchTile {
 public:
  TorchTile(std::shared_ptr<TorchWeights> weights, int rows);

  int rows() const { return rows_; }
  /// The largest of the usual tile sizes whose rows' bits depend neither on their place nor on
  /// their neighbours; 1 at worst.
  static int VerifiedRows(const std::shared_ptr<TorchWeights>& weights);

  /// Inputs of one row, to be written before Run; as FlowModel::Step has them.
  float* past(int row) { return Row(kPast, row); }
  float* audio(int row) { return Row(kAudio, row); }
  float* has_audio(int row) { return Row(kHasAudio, row); }
  float* condition(int row) { return Row(kCondition, row); }
  float* noise(int row) { return Row(kNoise, row); }

  /// Steps every row. `state` [rows, StateWidth()], on the device, is replaced.
  void Run(FlowState* state);

  /// Outputs of one row, valid until the next Run.
  const float* features(int row) const { return features_[row].data_ptr<float>(); }
  float log_likelihood(int row) const { return log_likelihood_.data_ptr<float>()[row]; }

 private:
  enum Input { kPast, kAudio, kHasAudio, kCondition, kNoise, kInputs };
  float* Row(Input input, int row) {
    return host_[input].data_ptr<float>() + row * host_[input].stride(0);
  }
  bool RowsAreIndependent();

  std::shared_ptr<TorchWeights> weights_;
  int rows_;
  torch::Tensor host_[kInputs];   ///< [rows, ...], pinned for CUDA
  torch::Tensor features_;        ///< [rows, width], on the CPU
  torch::Tensor log_likelihood_;  ///< [rows], on the CPU
};

}  // namespace choreo
