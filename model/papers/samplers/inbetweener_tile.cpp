#include "model/papers/samplers/inbetweener_tile.h"

#include <torch/torch.h>

#include <algorithm>
#include <utility>

namespace choreo {

using torch::Tensor;

InbetweenerTile::InbetweenerTile(Inbetweener model, int slots)
    : model_(std::move(model)), slots_(static_cast<size_t>(slots)) {}

void InbetweenerTile::Begin(int slot, Eigen::MatrixXf conditions) {
  const c10::InferenceMode inference;
  slots_[static_cast<size_t>(slot)] = {std::move(conditions), model_->InitialState(1)};
}

void InbetweenerTile::Run(std::span<FlowRow> rows) {
  const c10::InferenceMode inference;
  const int64_t width = model_->feature_width();
  for (FlowRow& row : rows) {
    Slot& slot = slots_[static_cast<size_t>(row.slot)];
    // Of the history all is new, later the last frame alone.
    std::vector<float> seen(row.past.begin(), row.past.end());
    Tensor past = torch::from_blob(seen.data(), {1, std::ssize(seen) / width, width});
    if (row.frame > 0) past = past.narrow(1, past.size(1) - 2, 2);
    const Tensor condition =
        torch::from_blob(slot.conditions.col(row.frame).data(), {1, slot.conditions.rows()});
    const Tensor features = model_->Step(past, condition, Tensor(), &slot.state).contiguous();
    std::copy_n(features.data_ptr<float>(), width, row.features.data());
  }
}

}  // namespace choreo
