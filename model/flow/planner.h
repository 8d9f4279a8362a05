#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>
#include <torch/nn/pimpl.h>
#include <torch/types.h>

#include "model/flow/flow_config.h"

namespace choreo {

/// A batch of transitions of equal length as a network sees them; canonical frame, metres, radians,
/// float32.
struct TransitionTensors {
  int64_t frames = 0;              ///< N
  torch::Tensor history_position;  ///< [batch, tau, 3]
  torch::Tensor history_rotation;  ///< [batch, tau, joints, 3, 3]
  torch::Tensor target_position;   ///< [batch, 3]
  torch::Tensor target_rotation;   ///< [batch, joints, 3, 3]
  torch::Tensor target_mask;       ///< [batch, joints + 1] in {0, 1}: each joint, then the root
                                   ///< position; zeros: no key
};

/// A trajectory of poses: position [batch, N, 3], rotation [batch, N, joints, 3, 3].
struct TrajectoryTensors {
  torch::Tensor position, rotation;
};

/// Interpolation from the last history pose to the key (lerp and slerp, the field's first
/// baseline); what the key does not name stays as it is. Frame N-1 is the key. `as_turning`: the
/// root goes the way round that the history leads to, not always the shorter one.
TrajectoryTensors Interpolate(const TransitionTensors& transition, bool as_turning = false);

/// Sinusoidal embedding of frame counts, Eq. 9: `counts` [...] → [..., width]; even places sine,
/// odd ones cosine, basis 10 000.
torch::Tensor TimeEmbedding(const torch::Tensor& counts, int64_t width);

/// Pre-norm transformer block with a learnt bias for every clipped distance in time.
class PlannerBlockImpl : public torch::nn::Module {
 public:
  PlannerBlockImpl(int width, int heads);
  /// x [batch, time, width]; distance [time, time] indices into the bias table.
  torch::Tensor forward(const torch::Tensor& x, const torch::Tensor& distance);

 private:
  int heads_;
  torch::nn::LayerNorm attention_norm_{nullptr}, mlp_norm_{nullptr};
  torch::nn::Linear qkv_{nullptr}, out_{nullptr}, up_{nullptr}, down_{nullptr};
  torch::Tensor distance_bias_;  // [2 * kMaxDistance + 1, heads]
};
TORCH_MODULE(PlannerBlock);

/// Proposes the mean of a transition: interpolation plus a smooth residual from a transformer over
/// history, gap and key. Not part of either paper; docs/decisions.md says why it is here. It hears
/// no music, so a live transition starts without waiting for its own.
class PlannerImpl : public torch::nn::Module {
 public:
  PlannerImpl(int joints, const PlannerConfig& config);

  struct Plan {
    TrajectoryTensors trajectory;
    torch::Tensor hidden;  ///< [batch, N, width]: what the planner knows of each frame, for the
                           ///< flow to condition on
  };
  Plan forward(const TransitionTensors& transition);
  /// Spread of real poses, [3 + 6 joints] (root position, 6D rotations): tokens and residuals are
  /// in these units, without which training hardly moves.
  void SetPoseNormalisation(const torch::Tensor& mean, const torch::Tensor& std);
  int width() const { return width_; }

 private:
  int joints_, width_;
  torch::Tensor pose_mean_, pose_std_;
  torch::nn::Linear embed_{nullptr}, head_{nullptr};
  torch::nn::LayerNorm norm_{nullptr};
  torch::nn::ModuleList blocks_;
};
TORCH_MODULE(Planner);

}  // namespace choreo
