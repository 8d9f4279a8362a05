#include "model/engine/transition_window.h"

#include <algorithm>
#include <utility>

#include "model/engine/temperature.h"

namespace choreo {

TransitionWindow::TransitionWindow(const ModelInfo& model)
    : skeleton_(model.skeleton),
      fps_(model.fps),
      tau_(model.history_frames),
      audio_features_(model.audio_features),
      hears_music_(model.hears_music),
      fine_temperature_(static_cast<float>(model.fine_temperature)),
      follow_(static_cast<float>(model.follow)),
      codec_(model.skeleton),
      past_(static_cast<size_t>(tau_ * codec_.width())),
      audio_(static_cast<size_t>((tau_ + 1) * audio_features_)),
      contacts_(model.skeleton),
      proposed_(static_cast<size_t>(codec_.width())) {}

void TransitionWindow::Begin(const TransitionSpec& spec, std::span<const Pose> plan) {
  frames_ = spec.frames;
  frame_ = 0;
  seed_ = spec.seed;
  candidate_ = spec.candidate;
  first_frame_ = spec.first_frame;
  has_audio_ = spec.has_audio && hears_music_;
  plan_.resize(plan.size() * static_cast<size_t>(3 + 3 * skeleton_.joints()));
  float* out = plan_.data();
  for (const Pose& pose : plan) {
    for (const double value : pose.root_position) *out++ = static_cast<float>(value);
    for (const double value : pose.rotations.reshaped()) *out++ = static_cast<float>(value);
  }

  std::vector<JointPlacement> placements;
  for (const Pose& pose : spec.history) placements.push_back(ForwardKinematics(skeleton_, pose));
  contacts_.Reset();
  for (int t = 0; t < tau_; ++t) {
    // The first frame takes its speed from the step that follows it.
    const auto before = static_cast<size_t>(std::max(0, t - 1));
    const auto now = static_cast<size_t>(t == 0 ? std::min(1, tau_ - 1) : t);
    contacts_.Next(placements[before].positions, placements[now].positions, fps_);
    // With a plan, history stands on itself, as in training.
    const Pose& pose = spec.history[static_cast<size_t>(t)];
    codec_.Encode(pose, spec.history[before], plan_.empty() ? nullptr : &pose, contacts_.contacts(),
                  fps_, PastRow(t));
  }
  if (tau_ > 1) {
    PastRow(0).segment<3>(codec_.velocity_at()) = PastRow(1).segment<3>(codec_.velocity_at());
  }
  noise_ = spec.temperature * fine_temperature_;
  if (!plan_.empty()) noise_ *= NoiseShare(spec, Roughness(skeleton_, spec.history));
  last_placement_ = std::move(placements.back());
  last_ = spec.history.back();

  std::ranges::fill(audio_, 0.0F);
  if (has_audio_) {
    Eigen::Map<Eigen::MatrixXf>(audio_.data(), audio_features_, tau_) = spec.audio_history;
  }
}

const Pose* TransitionWindow::Reference(int frame) {
  if (plan_.empty()) return nullptr;
  const int joints = skeleton_.joints();
  const float* at = plan_.data() + static_cast<ptrdiff_t>(frame) * (3 + 3 * joints);
  reference_.root_position = Eigen::Map<const Eigen::Vector3f>(at).cast<double>();
  reference_.rotations = Eigen::Map<const Eigen::Matrix3Xf>(at + 3, 3, joints).cast<double>();
  return &reference_;
}

void TransitionWindow::Advance(const StepInput& input) {
  if (input.previous != nullptr) {
    std::copy(past_.begin() + codec_.width(), past_.end(), past_.begin());
    ForwardKinematics(skeleton_, *input.previous, placement_);
    contacts_.Next(last_placement_.positions, placement_.positions, fps_);
    codec_.Encode(*input.previous, last_, Reference(frame_ - 1), contacts_.contacts(), fps_,
                  PastRow(tau_ - 1));
    last_ = *input.previous;
    std::swap(last_placement_, placement_);
  }
  if (has_audio_) {
    // Begin left the last row free for frame 0's.
    if (frame_ > 0) std::copy(audio_.begin() + audio_features_, audio_.end(), audio_.begin());
    std::ranges::copy(input.audio_row, audio_.end() - audio_features_);
  }
}

void TransitionWindow::Finish(std::span<const float> features, StepOutput* output) {
  std::ranges::copy(features, proposed_.begin());
  if (!plan_.empty()) {
    const auto pose = static_cast<size_t>(codec_.velocity_at());
    const float* last = PastRow(tau_ - 1).data();
    for (size_t i = 0; i < pose; ++i) proposed_[i] = last[i] + follow_ * (proposed_[i] - last[i]);
  }
  codec_.Decode(Eigen::Map<const Eigen::VectorXf>(proposed_.data(),
                                                  static_cast<Eigen::Index>(proposed_.size())),
                Reference(frame_), decoded_);
  output->pose = decoded_.pose;
  for (size_t foot = 0; foot < output->contacts.size(); ++foot) {
    output->contacts[foot] = std::clamp(decoded_.contacts[foot], 0.0F, 1.0F);
  }
  ++frame_;
}

}  // namespace choreo
