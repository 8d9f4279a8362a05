#include "model/engine/transition_window.h"

#include <algorithm>
#include <utility>

namespace choreo {

TransitionWindow::TransitionWindow(const ModelInfo& model, const TransitionSpec& spec)
    : skeleton_(model.skeleton),
      fps_(model.fps),
      tau_(model.history_frames),
      audio_features_(model.audio_features),
      codec_(model.skeleton),
      past_(static_cast<size_t>(tau_ * codec_.width())),
      audio_(static_cast<size_t>((tau_ + 1) * audio_features_)),
      frames_(spec.frames),
      first_noise_{spec.seed, spec.first_frame, spec.candidate, spec.temperature},
      has_audio_(spec.has_audio && model.hears_music),
      last_(spec.history.back()),
      contacts_(model.skeleton) {
  std::vector<JointPlacement> placements;
  for (const Pose& pose : spec.history) placements.push_back(ForwardKinematics(skeleton_, pose));
  for (int t = 0; t < tau_; ++t) {
    // The first frame takes its speed from the step that follows it.
    const auto before = static_cast<size_t>(std::max(0, t - 1));
    const auto now = static_cast<size_t>(t == 0 ? std::min(1, tau_ - 1) : t);
    contacts_.Next(placements[before].positions, placements[now].positions, fps_);
    codec_.Encode(spec.history[static_cast<size_t>(t)], spec.history[before], contacts_.contacts(),
                  fps_, PastRow(t));
  }
  if (tau_ > 1) {
    PastRow(0).segment<3>(codec_.velocity_at()) = PastRow(1).segment<3>(codec_.velocity_at());
  }
  last_placement_ = std::move(placements.back());
  if (has_audio_) {
    Eigen::Map<Eigen::MatrixXf>(audio_.data(), audio_features_, tau_) = spec.audio_history;
  }
}

void TransitionWindow::Advance(const StepInput& input) {
  if (input.previous != nullptr) {
    std::copy(past_.begin() + codec_.width(), past_.end(), past_.begin());
    ForwardKinematics(skeleton_, *input.previous, placement_);
    contacts_.Next(last_placement_.positions, placement_.positions, fps_);
    codec_.Encode(*input.previous, last_, contacts_.contacts(), fps_, PastRow(tau_ - 1));
    last_ = *input.previous;
    std::swap(last_placement_, placement_);
  }
  if (has_audio_) {
    // The last row was left free for frame 0's.
    if (frame_ > 0) std::copy(audio_.begin() + audio_features_, audio_.end(), audio_.begin());
    std::ranges::copy(input.audio_row, audio_.end() - audio_features_);
  }
}

void TransitionWindow::Finish(std::span<const float> features, StepOutput* output) {
  codec_.Decode(Eigen::Map<const Eigen::VectorXf>(features.data(),
                                                  static_cast<Eigen::Index>(features.size())),
                decoded_);
  output->pose = decoded_.pose;
  for (size_t foot = 0; foot < output->contacts.size(); ++foot) {
    output->contacts[foot] = std::clamp(decoded_.contacts[foot], 0.0F, 1.0F);
  }
  ++frame_;
}

}  // namespace choreo
