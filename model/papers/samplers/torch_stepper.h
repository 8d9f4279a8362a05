#pragma once

#include <torch/types.h>

#include <memory>
#include <span>
#include <vector>

#include "model/papers/networks/frame_flow_model.h"
#include "model/papers/samplers/flow_stepper.h"

namespace choreo {

/// Weights on one device, shared by the engines there. Read-only.
struct TorchWeights {
  FlowModel model{nullptr};  ///< in eval mode
  std::vector<torch::Tensor> inverse_weights;
  torch::Device device{torch::kCPU};
};

/// Runs the flow with LibTorch on the CPU or CUDA, with inputs and outputs in host memory. It is
/// the reference for PackedStepper.
class TorchStepper : public FlowStepper {
 public:
  explicit TorchStepper(std::shared_ptr<TorchWeights> weights);

  void StartTransition(Eigen::MatrixXf conditions) override;
  void Step(FlowFrame* frame) override;

 private:
  /// Two rows; the second is padding (zeros). LibTorch computes a tensor's last elements one by one
  /// and the others as vectors, which may round differently.
  static constexpr int64_t kRows = 2;

  /// Columns of the input.
  enum Part { kPast, kAudio, kHasAudio, kCondition, kNoise, kParts };
  std::span<float> Row(Part part);
  torch::Tensor Input(Part part) const;

  std::shared_ptr<TorchWeights> weights_;
  std::vector<float> static_condition_;  ///< [frames, static_width]
  int64_t begin_[kParts + 1];            ///< [parts] first column of each

  // A step's inputs and outputs, here (pinned for CUDA) and on the device; the same on the CPU.
  torch::Tensor host_input_, input_;  ///< [kRows, begin_[kParts]]
  torch::Tensor host_output_;         ///< [kRows, width + 1]: features, log-likelihood
  FlowState state_;                   ///< [kRows, StateWidth()], on the device
};

}  // namespace choreo
