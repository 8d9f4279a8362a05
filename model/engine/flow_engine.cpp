#include "model/engine/flow_engine.h"

#include <algorithm>
#include <utility>

#include "model/flow/key_condition.h"
#include "model/motion/pose_codec.h"

namespace choreo {

FlowEngine::FlowEngine(ModelInfo info, FlowConfig config, std::string device, int slots,
                       std::unique_ptr<FlowTile> tile)
    : SlotEngine(std::move(info), std::move(device), slots),
      config_(std::move(config)),
      tile_(std::move(tile)),
      rows_(static_cast<size_t>(tile_->rows())) {
  const auto width = static_cast<size_t>(PoseCodec(model().skeleton).width());
  features_.resize(rows_.size() * width);
  for (size_t row = 0; row < rows_.size(); ++row) {
    rows_[row].features = {features_.data() + row * width, width};
  }
}

TransitionWindow FlowEngine::Begin(const TransitionSpec& spec, int slot) {
  const PoseCodec codec(model().skeleton);
  tile_->Begin(slot, KeyConditions(config_, codec.joints(), codec.width(), spec.frames,
                                   spec.target ? &spec.target->pose : nullptr,
                                   spec.target ? spec.target->mask : PoseMask{}));
  return {model(), spec};
}

void FlowEngine::StepTile(std::span<const StepInput> in, std::span<StepOutput> out) {
  for (size_t i = 0; i < in.size(); ++i) {
    const TransitionWindow& window = At(in[i]);
    FlowRow& row = rows_[i];
    row.slot = in[i].slot;
    row.frame = window.frame();
    row.past = window.past();
    row.audio = window.audio();
    row.has_audio = window.has_audio();
    row.noise = window.noise();
  }
  tile_->Run({rows_.data(), in.size()});
  for (size_t i = 0; i < in.size(); ++i) {
    At(in[i]).Finish(rows_[i].features, &out[i]);
    out[i].log_likelihood = rows_[i].log_likelihood;
  }
}

void FlowEngine::StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) {
  for (const StepInput& input : in) At(input).Advance(input);
  for (size_t first = 0; first < in.size(); first += rows_.size()) {
    const size_t count = std::min(rows_.size(), in.size() - first);
    StepTile(in.subspan(first, count), out.subspan(first, count));
  }
}

}  // namespace choreo
