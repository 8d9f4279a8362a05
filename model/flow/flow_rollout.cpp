#include <torch/torch.h>

#include "model/flow/flow_model.h"
#include "model/flow/torch_kinematics.h"

/// Features ↔ poses on batches, and sampling on the model's own history: what training and
/// evaluation add to a single Step.
namespace choreo {

using torch::Tensor;

Tensor FlowModelImpl::RelativeFeatures(const Tensor& absolute, const TrajectoryTensors& truth,
                                       const TransitionContext& context) const {
  if (!context.reference.position.defined()) return absolute;
  const int64_t tau = config_.history_frames, pose_width = 3 + 3 * skeleton_.joints();
  const Tensor move = truth.position - context.reference.position;
  const Tensor turn =
      LogMapBatch(torch::matmul(context.reference.rotation.transpose(-1, -2), truth.rotation));
  const Tensor relative = torch::cat({move, turn.flatten(2)}, -1);
  const Tensor history = torch::zeros({absolute.size(0), tau, pose_width}, absolute.options());
  return torch::cat(
      {torch::cat({history, relative}, 1), absolute.narrow(2, pose_width, width_ - pose_width)},
      -1);
}

TrajectoryTensors FlowModelImpl::Decode(const Tensor& features,
                                        const TransitionContext& context) const {
  const int64_t joints = skeleton_.joints();
  const Tensor position = features.narrow(-1, 0, 3);
  const Tensor rotation = ExpMapBatch(
      features.narrow(-1, 3, 3 * joints).reshape({features.size(0), features.size(1), joints, 3}));
  if (!context.reference.position.defined()) return {position, rotation};
  return {context.reference.position + position,
          torch::matmul(context.reference.rotation, rotation)};
}

Tensor FlowModelImpl::Rollout(const Tensor& history, const Tensor& audio, const Tensor& has_audio,
                              const TransitionContext& context, const Tensor& noise) {
  const int64_t tau = config_.history_frames, frames = noise.size(1);
  const std::vector<Tensor> inverse_weights = InverseWeights();
  FlowState state = flow_->InitialState(noise.size(0));
  std::vector<Tensor> past = history.unbind(1);
  for (int64_t t = 0; t < frames; ++t) {
    const std::vector<Tensor> window(past.end() - tau, past.end());
    past.push_back(Step(torch::stack(window, 1), audio.narrow(1, t, tau + 1), has_audio,
                        context.static_condition.select(1, t), noise.select(1, t), inverse_weights,
                        &state)
                       .features);
  }
  return torch::stack(std::vector<Tensor>(past.begin() + tau, past.end()), 1);
}

}  // namespace choreo
