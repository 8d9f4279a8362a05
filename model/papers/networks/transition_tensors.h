#pragma once

#include <torch/types.h>

#include "model/motion/skeleton.h"
#include "model/papers/networks/flow_config.h"

namespace choreo {

/// A batch of transitions of equal length as a network's input; canonical frame, metres, radians,
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

/// Interpolates from the last history pose to the key by lerp and slerp, the usual baseline.
/// Degrees of freedom outside the key's mask stay unchanged. Frame N-1 is the key.
TrajectoryTensors Interpolate(const TransitionTensors& transition);

/// Decodes features [batch, N, width], which may be a network's output, to poses
/// (motion/pose/pose_codec.h). Differentiable.
TrajectoryTensors DecodePoses(const Skeleton& skeleton, const torch::Tensor& features);

/// KeyConditions of each transition (key_condition.h), [batch, N, KeyConditionWidth], on the
/// transition's device.
torch::Tensor KeyConditionTensors(const FlowConfig& config, const Skeleton& skeleton,
                                  const TransitionTensors& transition);

/// EmbedCountAt for all elements: `counts` [...] → [..., width].
torch::Tensor TimeEmbedding(const torch::Tensor& counts, int64_t width);

}  // namespace choreo
