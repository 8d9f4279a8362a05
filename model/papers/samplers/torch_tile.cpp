#include "model/papers/samplers/torch_tile.h"

#include <torch/torch.h>

#include <algorithm>
#include <utility>

namespace choreo {

using torch::Tensor;

TorchTile::TorchTile(std::shared_ptr<TorchWeights> weights, int slots)
    : weights_(std::move(weights)),
      padded_(slots + 1),
      spare_(slots),
      static_conditions_(static_cast<size_t>(slots)),
      states_(torch::zeros({slots + 1, weights_->model->StateWidth()}, weights_->device)) {
  const FlowModel& model = weights_->model;
  const FlowConfig& config = model->config();
  const int64_t tau = config.history_frames, width = model->feature_width();
  const int64_t widths[kParts] = {
      tau * width, config.HeardWidth(), 1, model->static_width(), width, 1};
  begin_[0] = 0;
  for (int part = 0; part < kParts; ++part) begin_[part + 1] = begin_[part] + widths[part];
  const auto here = torch::TensorOptions().pinned_memory(weights_->device.is_cuda());
  host_input_ = torch::zeros({padded_, begin_[kParts]}, here);
  host_slots_ = torch::full({padded_}, spare_, here.dtype(torch::kLong));
  host_output_ = torch::zeros({padded_, width + 1}, here);
  input_ = host_input_.to(weights_->device);
  slots_ = host_slots_.to(weights_->device);
}

std::span<float> TorchTile::Row(Part part, size_t row) {
  float* begin = host_input_.data_ptr<float>() + static_cast<int64_t>(row) * begin_[kParts];
  return {begin + begin_[part], begin + begin_[part + 1]};
}

Tensor TorchTile::Input(Part part) const {
  return input_.narrow(1, begin_[part], begin_[part + 1] - begin_[part]);
}

void TorchTile::Begin(int slot, Eigen::MatrixXf conditions) {
  const c10::InferenceMode inference;
  const Tensor raw = torch::from_blob(conditions.data(), {conditions.cols(), conditions.rows()});
  FlowModel model = weights_->model;
  const Tensor encoded = model->Encode(raw.to(weights_->device)).cpu().contiguous();
  static_conditions_[static_cast<size_t>(slot)].assign(encoded.data_ptr<float>(),
                                                       encoded.data_ptr<float>() + encoded.numel());
}

void TorchTile::Run(std::span<FlowRow> rows) {
  auto* slots = host_slots_.data_ptr<int64_t>();
  for (size_t i = 0; i < rows.size(); ++i) {
    const FlowRow& row = rows[i];
    std::ranges::copy(row.past, Row(kPast, i).begin());
    std::ranges::copy(row.audio, Row(kAudio, i).begin());
    Row(kHasAudio, i)[0] = row.has_audio ? 1.0F : 0.0F;
    const std::span<float> condition = Row(kCondition, i);
    std::copy_n(static_conditions_[static_cast<size_t>(row.slot)].data() +
                    static_cast<size_t>(row.frame) * condition.size(),
                condition.size(), condition.begin());
    Row(kUnderWay, i)[0] = row.frame > 0 ? 1.0F : 0.0F;
    row.noise.Fill(Row(kNoise, i));
    slots[i] = row.slot;
  }
  // Rows beyond these are padding: they hold what was there, and are dropped.
  std::fill(slots + rows.size(), slots + padded_, spare_);
  Compute();
  const int64_t width = host_output_.size(1) - 1;
  for (size_t i = 0; i < rows.size(); ++i) {
    const float* row = host_output_.data_ptr<float>() + static_cast<int64_t>(i) * (width + 1);
    std::copy_n(row, width, rows[i].features.data());
    rows[i].log_likelihood = row[width];
  }
}

void TorchTile::Compute() {
  const c10::InferenceMode inference;
  if (input_.is_cuda()) {
    input_.copy_(host_input_, /*non_blocking=*/true);
    slots_.copy_(host_slots_, /*non_blocking=*/true);
  }
  FlowModel model = weights_->model;
  const int64_t tau = model->config().history_frames;
  // A transition starts from a state of zero.
  const Tensor before = states_.index_select(0, slots_);
  FlowState state = torch::where(Input(kUnderWay) > 0, before, torch::zeros_like(before));
  const FlowModelImpl::StepResult result = model->Step(
      Input(kPast).reshape({padded_, tau, -1}), Input(kAudio).reshape({padded_, tau + 1, -1}),
      Input(kHasAudio), Input(kCondition), Input(kNoise), weights_->inverse_weights, &state);
  states_.index_copy_(0, slots_, state);
  host_output_.copy_(torch::cat({result.features, result.log_likelihood.unsqueeze(1)}, 1),
                     /*non_blocking=*/true);
}

}  // namespace choreo
