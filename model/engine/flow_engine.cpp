#include "model/engine/flow_engine.h"

#include <algorithm>
#include <utility>

#include "model/flow/key_condition.h"

namespace choreo {

TransitionWindow::TransitionWindow(const ModelInfo& model, const TransitionSpec& spec)
    : model_(&model),
      codec_(model.skeleton),
      past_(static_cast<size_t>(model.history_frames * codec_.width())),
      audio_(static_cast<size_t>((model.history_frames + 1) * model.audio_features)),
      progress_{0, spec.frames, spec.has_audio && model.hears_music},
      noise_{spec.seed, spec.first_frame, spec.candidate, spec.temperature},
      last_(spec.history.back()),
      contacts_(model.skeleton) {
  const int tau = model.history_frames;
  std::vector<JointPlacement> placements;
  for (const Pose& pose : spec.history)
    placements.push_back(ForwardKinematics(model.skeleton, pose));
  for (int t = 0; t < tau; ++t) {
    // The first frame takes its speed from the step that follows it.
    const auto before = static_cast<size_t>(std::max(0, t - 1));
    const auto now = static_cast<size_t>(t == 0 ? std::min(1, tau - 1) : t);
    contacts_.Next(placements[before].positions, placements[now].positions, model.fps);
    codec_.Encode(spec.history[static_cast<size_t>(t)], spec.history[before], contacts_.contacts(),
                  model.fps, PastRow(t));
  }
  if (tau > 1) {
    PastRow(0).segment<3>(codec_.velocity_at()) = PastRow(1).segment<3>(codec_.velocity_at());
  }
  last_placement_ = std::move(placements.back());
  if (progress_.hears)
    Eigen::Map<Eigen::MatrixXf>(audio_.data(), model.audio_features, tau) = spec.audio_history;
}

void TransitionWindow::Advance(const StepInput& input) {
  if (input.previous != nullptr) {
    std::copy(past_.begin() + codec_.width(), past_.end(), past_.begin());
    ForwardKinematics(model_->skeleton, *input.previous, placement_);
    contacts_.Next(last_placement_.positions, placement_.positions, model_->fps);
    codec_.Encode(*input.previous, last_, contacts_.contacts(), model_->fps,
                  PastRow(model_->history_frames - 1));
    last_ = *input.previous;
    std::swap(last_placement_, placement_);
  }
  if (progress_.hears) {
    const int row = model_->audio_features;
    // The last row was left free for frame 0's.
    if (progress_.frame > 0) std::copy(audio_.begin() + row, audio_.end(), audio_.begin());
    std::ranges::copy(input.audio_row, audio_.end() - row);
  }
}

void TransitionWindow::FillRow(FlowRow* row) const {
  row->frame = progress_.frame;
  row->past = past_;
  row->audio = audio_;
  row->has_audio = progress_.hears;
  row->noise = noise_;
}

void TransitionWindow::Finish(const FlowRow& row, StepOutput* output) {
  codec_.Decode(Eigen::Map<const Eigen::VectorXf>(row.features.data(), codec_.width()), decoded_);
  output->pose = decoded_.pose;
  for (size_t foot = 0; foot < output->contacts.size(); ++foot) {
    output->contacts[foot] = std::clamp(decoded_.contacts[foot], 0.0F, 1.0F);
  }
  output->log_likelihood = row.log_likelihood;
  ++progress_.frame;
  ++noise_.frame;
}

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

void FlowEngine::StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) {
  for (const StepInput& input : in) At(input).Advance(input);
  for (size_t first = 0; first < in.size(); first += rows_.size()) {
    const auto some = in.subspan(first, std::min(rows_.size(), in.size() - first));
    for (size_t i = 0; i < some.size(); ++i) {
      rows_[i].slot = some[i].slot;
      At(some[i]).FillRow(&rows_[i]);
    }
    tile_->Run({rows_.data(), some.size()});
    for (size_t i = 0; i < some.size(); ++i) At(some[i]).Finish(rows_[i], &out[first + i]);
  }
}

}  // namespace choreo
