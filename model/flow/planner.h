#pragma once

#include <torch/nn/module.h>
#include <torch/types.h>

#include <memory>

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
  /// [batch, 3] rotation vector: of the two ways round that the root can turn to the key, the one
  /// nearer to this is taken. Undefined: nearer to what the last frames' turning leads to.
  torch::Tensor turning = {};
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

/// Proposes the mean of a transition once, from history, gap and key, for the flow to dance around.
/// Not part of paper F; docs/decisions.md says why it is here. It hears no music, so a live
/// transition starts without waiting for its own.
class PlannerImpl : public torch::nn::Module {
 public:
  struct Plan {
    TrajectoryTensors trajectory;
    torch::Tensor hidden;  ///< [batch, N, width]: what the planner knows of each frame, for the
                           ///< flow to condition on
  };
  virtual Plan forward(const TransitionTensors& transition) = 0;
  /// The mean of what `forward` makes of the transition and, mirrored back, of its mirror image: no
  /// side is better. Where no root position is asked for, without the steady walk of that mean.
  Plan Balanced(const TransitionTensors& transition, const torch::Tensor& pairs);
  /// Spread of real poses, [3 + 6 joints] (root position, 6D rotations): tokens and residuals are
  /// in these units, without which training hardly moves.
  void SetPoseNormalisation(const torch::Tensor& mean, const torch::Tensor& std);

 protected:
  explicit PlannerImpl(int joints);
  /// Positions [..., 3] and rotations [..., joints, 3, 3] → [..., 3 + 6 joints], standardised.
  torch::Tensor PoseFeatures(const TrajectoryTensors& poses) const;

  int joints_;
  torch::Tensor pose_mean_, pose_std_;
};
using Planner = std::shared_ptr<PlannerImpl>;

/// The transition seen in a mirror; `pairs` [joints] as motion/mirror.h has them.
TransitionTensors MirrorTransition(const TransitionTensors& transition, const torch::Tensor& pairs);

/// The planner that `config` asks for; none where its width is 0.
Planner MakePlanner(int joints, const PlannerConfig& config);

}  // namespace choreo
