#include "model/engine/flow_engine.h"

#include <algorithm>
#include <utility>

#include "model/core/error.h"
#include "model/flow/key_condition.h"
#include "model/motion/pose_codec.h"

namespace choreo {

FlowEngine::FlowEngine(ModelInfo info, FlowConfig config, std::string device, int slots,
                       std::unique_ptr<FlowTile> tile)
    : info_(std::move(info)),
      config_(std::move(config)),
      device_(std::move(device)),
      slots_(static_cast<size_t>(slots), Slot(info_)),
      tile_(std::move(tile)),
      rows_(static_cast<size_t>(tile_->rows())) {
  const auto width = static_cast<size_t>(PoseCodec(info_.skeleton).width());
  features_.resize(rows_.size() * width);
  for (size_t row = 0; row < rows_.size(); ++row) {
    rows_[row].features = {features_.data() + row * width, width};
  }
}

int FlowEngine::free_slots() const {
  return static_cast<int>(std::ranges::count(slots_, false, &Slot::taken));
}

int FlowEngine::Admit(const TransitionSpec& spec) {
  ValidateSpec(spec, info_);
  const auto free = std::ranges::find(slots_, false, &Slot::taken);
  if (free == slots_.end()) {
    throw Error(ErrorCode::kResourceExhausted, "",
                "all " + std::to_string(slots_.size()) + " slots are taken");
  }
  const int slot = static_cast<int>(free - slots_.begin());
  const PoseCodec codec(info_.skeleton);
  tile_->Begin(slot, KeyConditions(config_, codec.joints(), codec.width(), spec.frames,
                                   spec.target ? &spec.target->pose : nullptr,
                                   spec.target ? spec.target->mask : PoseMask{}));
  free->window.Begin(spec);
  free->taken = true;
  return slot;
}

void FlowEngine::StepTile(std::span<const StepInput> in, std::span<StepOutput> out) {
  for (size_t i = 0; i < in.size(); ++i) {
    const TransitionWindow& window = At(in[i]).window;
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
    At(in[i]).window.Finish(rows_[i].features, &out[i]);
    out[i].log_likelihood = rows_[i].log_likelihood;
  }
}

void FlowEngine::Step(std::span<const StepInput> in, std::span<StepOutput> out) {
  ValidateSteps(in, out.size(), slots(), info_, [this](int slot) {
    const Slot& of = slots_[static_cast<size_t>(slot)];
    return of.taken ? std::optional(of.window.progress()) : std::nullopt;
  });
  for (const StepInput& input : in) At(input).window.Advance(input);
  for (size_t first = 0; first < in.size(); first += rows_.size()) {
    const size_t count = std::min(rows_.size(), in.size() - first);
    StepTile(in.subspan(first, count), out.subspan(first, count));
  }
}

}  // namespace choreo
