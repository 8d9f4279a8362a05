#include "model/engine/torch_tile.h"

#include <torch/torch.h>

#include <span>

#include "model/core/random.h"

namespace choreo {

using torch::Tensor;

TorchTile::TorchTile(std::shared_ptr<TorchWeights> weights, int rows)
    : weights_(std::move(weights)), rows_(rows) {
  const FlowModel& model = weights_->model;
  const FlowConfig& config = model->config();
  const auto options = torch::TensorOptions().pinned_memory(weights_->device.is_cuda());
  const int64_t tau = config.history_frames, width = model->feature_width();
  host_[kPast] = torch::zeros({rows, tau, width}, options);
  host_[kAudio] = torch::zeros({rows, tau + 1, config.audio_features}, options);
  host_[kHasAudio] = torch::zeros({rows, 1}, options);
  host_[kCondition] = torch::zeros({rows, model->static_width()}, options);
  host_[kNoise] = torch::zeros({rows, width}, options);
}

void TorchTile::Run(FlowState* state) {
  Tensor inputs[kInputs];
  for (int i = 0; i < kInputs; ++i) inputs[i] = host_[i].to(weights_->device, true);
  FlowModel model = weights_->model;
  const FlowModelImpl::StepResult result =
      model->Step(inputs[kPast], inputs[kAudio], inputs[kHasAudio], inputs[kCondition],
                  inputs[kNoise], weights_->inverse_weights, state);
  features_ = result.features.cpu().contiguous();
  log_likelihood_ = result.log_likelihood.cpu().contiguous();
}

// Two probes visit every place, each time among other neighbours.
bool TorchTile::RowsAreIndependent() {
  Random random(1);
  const int state_width = weights_->model->StateWidth();
  const auto fill = [&](Tensor tensor) {
    random.FillNormal({tensor.data_ptr<float>(), static_cast<size_t>(tensor.numel())});
  };
  for (int probe = 0; probe < 2; ++probe) {
    Tensor rows[kInputs + 1];  // the probe's inputs and state
    for (int i = 0; i < kInputs; ++i) fill(rows[i] = torch::empty_like(host_[i][0]));
    fill(rows[kInputs] = torch::empty({state_width}));
    Tensor expected;
    for (int place = 0; place < rows_; ++place) {
      for (int i = 0; i < kInputs; ++i) {
        fill(host_[i]);
        host_[i][place].copy_(rows[i]);
      }
      Tensor state = torch::empty({rows_, state_width});
      fill(state);
      state[place].copy_(rows[kInputs]);
      state = state.to(weights_->device);
      Run(&state);
      const Tensor result =
          torch::cat({features_[place], log_likelihood_[place].unsqueeze(0), state[place].cpu()});
      if (!expected.defined()) expected = result.clone();
      if (!torch::equal(result, expected)) return false;
    }
  }
  return true;
}

int TorchTile::VerifiedRows(const std::shared_ptr<TorchWeights>& weights) {
  constexpr int kRows = 16;
  return TorchTile(weights, kRows).RowsAreIndependent() ? kRows : 1;
}

}  // namespace choreo
