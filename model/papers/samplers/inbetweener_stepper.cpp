#include "model/papers/samplers/inbetweener_stepper.h"

#include <torch/types.h>

#include <algorithm>
#include <vector>

namespace choreo {

using torch::Tensor;

void InbetweenerStepper::StartTransition(Eigen::MatrixXf conditions) {
  const c10::InferenceMode inference;
  conditions_ = std::move(conditions);
  state_ = model_->InitialState(1);
}

void InbetweenerStepper::Step(FlowFrame* frame) {
  const c10::InferenceMode inference;
  const int64_t width = model_->feature_width();
  // The first step has the whole history as input, later ones only the new frame.
  std::vector<float> seen(frame->past.begin(), frame->past.end());
  Tensor past = torch::from_blob(seen.data(), {1, std::ssize(seen) / width, width});
  if (frame->frame > 0) past = past.narrow(1, past.size(1) - 2, 2);
  const Tensor condition =
      torch::from_blob(conditions_.col(frame->frame).data(), {1, conditions_.rows()});
  const Tensor features = model_->Step(past, condition, Tensor(), &state_).contiguous();
  std::copy_n(features.data_ptr<float>(), width, frame->features.data());
}

}  // namespace choreo
