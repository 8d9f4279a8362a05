#include "model/engine/torch_tile.h"

#include <torch/torch.h>

#include <algorithm>
#include <utility>

#include "model/core/random.h"

namespace choreo {

using torch::Tensor;

TorchTile::TorchTile(std::shared_ptr<TorchWeights> weights, int rows, int slots)
    : weights_(std::move(weights)),
      rows_(rows),
      states_(torch::zeros({slots, weights_->model->StateWidth()}, weights_->device)),
      static_conditions_(static_cast<size_t>(slots)) {
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

void TorchTile::Begin(int slot, std::vector<float> static_condition) {
  const c10::InferenceMode inference;
  states_[slot].zero_();
  static_conditions_[static_cast<size_t>(slot)] = std::move(static_condition);
}

void TorchTile::Run(std::span<FlowRow> rows) {
  const c10::InferenceMode inference;
  Tensor slots = torch::zeros({rows_}, torch::kLong);
  for (size_t i = 0; i < rows.size(); ++i) {
    const FlowRow& row = rows[i];
    std::ranges::copy(row.past, Row(kPast, i));
    std::ranges::copy(row.audio, Row(kAudio, i));
    *Row(kHasAudio, i) = row.has_audio ? 1.0F : 0.0F;
    const int64_t width = host_[kCondition].size(1);
    std::copy_n(static_conditions_[static_cast<size_t>(row.slot)].data() + row.frame * width, width,
                Row(kCondition, i));
    std::ranges::copy(row.noise, Row(kNoise, i));
    slots.data_ptr<int64_t>()[i] = row.slot;
  }
  // Rows beyond these are padding: they hold what was there, read slot 0's state, and are dropped.
  slots = slots.to(weights_->device);
  FlowState state = states_.index_select(0, slots);
  Compute(&state);
  if (state.size(1) > 0) {
    const auto count = static_cast<int64_t>(rows.size());
    states_.index_copy_(0, slots.narrow(0, 0, count), state.narrow(0, 0, count));
  }
  const int64_t width = features_.size(1);
  for (size_t i = 0; i < rows.size(); ++i) {
    std::copy_n(features_.data_ptr<float>() + static_cast<int64_t>(i) * width, width,
                rows[i].features.data());
    rows[i].log_likelihood = log_likelihood_.data_ptr<float>()[i];
  }
}

void TorchTile::Compute(FlowState* state) {
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
  const c10::InferenceMode inference;
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
      Compute(&state);
      const Tensor result =
          torch::cat({features_[place], log_likelihood_[place].unsqueeze(0), state[place].cpu()});
      if (!expected.defined()) expected = result.clone();
      if (!torch::equal(result, expected)) return false;
    }
  }
  return true;
}

int TorchTile::VerifiedRows(const std::shared_ptr<TorchWeights>& weights) {
  // OpenBLAS's AVX2 kernel takes up to 12 rows at once and the rest otherwise.
  for (const int rows : {16, 12, 8, 4}) {
    if (TorchTile(weights, rows, 1).RowsAreIndependent()) return rows;
  }
  return 1;
}

}  // namespace choreo
