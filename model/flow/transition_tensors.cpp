#include "model/flow/transition_tensors.h"

#include <torch/torch.h>

#include <vector>

#include "model/flow/time_embedding.h"
#include "model/flow/torch_kinematics.h"

namespace choreo {

using torch::Tensor;

TrajectoryTensors Interpolate(const TransitionTensors& transition) {
  const int64_t joints = transition.target_rotation.size(1);
  const Tensor u = torch::arange(1, transition.frames + 1, transition.target_position.options()) /
                   static_cast<double>(transition.frames);
  const Tensor from_position = transition.history_position.select(1, -1);
  const Tensor from_rotation = transition.history_rotation.select(1, -1);
  const Tensor joint_mask = transition.target_mask.narrow(1, 0, joints);
  const Tensor root_mask = transition.target_mask.narrow(1, joints, 1);
  const Tensor move = (transition.target_position - from_position) * root_mask;
  const Tensor turn =
      LogMapBatch(torch::matmul(from_rotation.transpose(-1, -2), transition.target_rotation)) *
      joint_mask.unsqueeze(-1);
  return {from_position.unsqueeze(1) + u.view({1, -1, 1}) * move.unsqueeze(1),
          torch::matmul(from_rotation.unsqueeze(1),
                        ExpMapBatch(u.view({1, -1, 1, 1}) * turn.unsqueeze(1)))};
}

Tensor TimeEmbedding(const Tensor& counts, int64_t width) {
  const Tensor each = counts.to(torch::kCPU, torch::kFloat64).contiguous();
  const Tensor embedded = torch::empty({counts.numel(), width}, torch::kFloat64);
  for (int64_t i = 0; i < embedded.numel(); ++i) {
    embedded.data_ptr<double>()[i] =
        EmbedCountAt(each.data_ptr<double>()[i / width], static_cast<size_t>(i % width),
                     static_cast<size_t>(width));
  }
  std::vector<int64_t> sizes = counts.sizes().vec();
  sizes.push_back(width);
  return embedded.view(sizes).to(counts.options());
}

}  // namespace choreo
