#pragma once

#include <map>
#include <utility>

#include "model/flow/continuous_flow.h"
#include "model/training/loss_terms.h"
#include "model/training/window_body.h"

namespace choreo {

/// The losses of flow matching (Lipman et al. 2023), in the continuous flow's parametrisation: of a
/// point z_t = (1 - t) noise + t z the network says F, where F* = ((1 - t) z - t noise) / sqrt(a),
/// a = t² + (1 - t)². On the device where the model is. Not thread-safe.
class FlowMatching {
 public:
  explicit FlowMatching(const ContinuousFlow& model);

  const FlowModelParts& parts() const { return parts_; }

  /// Squares alone, whose least is the mean of all ways: of F in white coordinates, which teaches
  /// how dancers move; of where the joints of the motion that F ends in are; and of how far its
  /// feet go in a frame in which real ones stand. Times and noise from torch's generator.
  /// The batch's tensors are on the model's device.
  LossTerms Losses(ContinuousFlow& model, const WindowBatch& batch);

 private:
  struct Spreads {
    torch::Tensor to_key, free;  // [dimensions, w, w] Cholesky factors
    torch::Tensor stage;         // [3, w, w] the root's, in place of the first that are free
  };
  const Spreads& Of(int frames, int to_key);
  FlowModelParts parts_;
  torch::Device device_;
  WindowBody body_;
  torch::Tensor mixing_;  // transposed
  torch::Tensor reach_;   // [dimensions] square metres that a square unit moves joints, on average
  std::map<std::pair<int, int>, Spreads> spreads_;
};

}  // namespace choreo
