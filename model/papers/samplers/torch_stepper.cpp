#include "model/papers/samplers/torch_stepper.h"

#include <algorithm>
#include <utility>

namespace choreo {

using torch::Tensor;

TorchStepper::TorchStepper(std::shared_ptr<TorchWeights> weights) : weights_(std::move(weights)) {
  const FlowModel& model = weights_->model;
  const FlowConfig& config = model->config();
  const int64_t tau = config.history_frames, width = model->feature_width();
  const int64_t widths[kParts] = {tau * width, config.HeardWidth(), 1, model->static_width(),
                                  width};
  begin_[0] = 0;
  for (int part = 0; part < kParts; ++part) begin_[part + 1] = begin_[part] + widths[part];
  const auto here = torch::TensorOptions().pinned_memory(weights_->device.is_cuda());
  host_input_ = torch::zeros({kRows, begin_[kParts]}, here);
  host_output_ = torch::zeros({kRows, width + 1}, here);
  input_ = host_input_.to(weights_->device);
}

std::span<float> TorchStepper::Row(Part part) {
  auto* begin = host_input_.data_ptr<float>();
  return {begin + begin_[part], begin + begin_[part + 1]};
}

Tensor TorchStepper::Input(Part part) const {
  return input_.narrow(1, begin_[part], begin_[part + 1] - begin_[part]);
}

void TorchStepper::StartTransition(Eigen::MatrixXf conditions) {
  const c10::InferenceMode inference;
  const Tensor raw = torch::from_blob(conditions.data(), {conditions.cols(), conditions.rows()});
  FlowModel model = weights_->model;
  const Tensor encoded = model->Encode(raw.to(weights_->device)).cpu().contiguous();
  static_condition_.assign(encoded.data_ptr<float>(), encoded.data_ptr<float>() + encoded.numel());
  state_ = torch::zeros({kRows, model->StateWidth()}, weights_->device);
}

void TorchStepper::Step(FlowFrame* frame) {
  const c10::InferenceMode inference;
  std::ranges::copy(frame->past, Row(kPast).begin());
  std::ranges::copy(frame->audio, Row(kAudio).begin());
  Row(kHasAudio)[0] = frame->has_audio ? 1.0F : 0.0F;
  const std::span<float> condition = Row(kCondition);
  std::copy_n(static_condition_.data() + static_cast<size_t>(frame->frame) * condition.size(),
              condition.size(), condition.begin());
  frame->FillNoise(Row(kNoise));
  if (input_.is_cuda()) input_.copy_(host_input_, /*non_blocking=*/true);
  FlowModel model = weights_->model;
  const int64_t tau = model->config().history_frames;
  const FlowModelImpl::StepResult result = model->Step(
      Input(kPast).reshape({kRows, tau, -1}), Input(kAudio).reshape({kRows, tau + 1, -1}),
      Input(kHasAudio), Input(kCondition), Input(kNoise), weights_->inverse_weights, &state_);
  host_output_.copy_(torch::cat({result.features, result.log_likelihood.unsqueeze(1)}, 1));
  const auto* output = host_output_.data_ptr<float>();
  std::ranges::copy_n(output, host_output_.size(1) - 1, frame->features.data());
  frame->log_likelihood = output[host_output_.size(1) - 1];
}

}  // namespace choreo
