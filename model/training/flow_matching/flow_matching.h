#pragma once

#include <map>
#include <utility>

#include "model/flow/network/continuous_flow.h"
#include "model/training/trainer/loss_terms.h"
#include "model/training/windows/window_body.h"

namespace choreo {

/// The losses of flow matching (Lipman et al. 2023) in the continuous flow's parametrisation: for a
/// point z_t = (1 - t) noise + t z the network predicts F*, where F* = ((1 - t) z - t noise) /
/// sqrt(a), a = t² + (1 - t)². Runs on the model's device. Not thread-safe.
class FlowMatching {
 public:
  explicit FlowMatching(const ContinuousFlow& model);

  const FlowModelParts& parts() const { return parts_; }

  /// Computes the losses. All are squared errors, so their minimum is the mean of all possible
  /// motions. One is of F in white coordinates, and teaches how dancers move. Two are of the motion
  /// in which F ends: its joint positions, and its feet's travel per frame where real feet stand.
  /// Times and noise come from torch's generator. The batch's tensors are on the model's device.
  LossTerms Losses(ContinuousFlow& model, const WindowBatch& batch);

 private:
  struct Spreads {
    torch::Tensor to_key, free;  // [dimensions, w, w] Cholesky factors
    torch::Tensor stage;         // [3, w, w] for the root, in place of the first three of `free`
  };
  const Spreads& Of(int frames, int to_key);
  FlowModelParts parts_;
  torch::Device device_;
  WindowBody body_;
  torch::Tensor mixing_;  // transposed
  torch::Tensor reach_;   // [dimensions] mean square movement of joints per square unit, m^2
  std::map<std::pair<int, int>, Spreads> spreads_;
};

}  // namespace choreo
