#include "model/papers/samplers/autoregressive_flow.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/motion/floor/contacts.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/pose_codec.h"
#include "model/papers/networks/key_condition.h"

namespace choreo {

/// The flow's inputs during a transition: the features of the last tau frames after arrival, and
/// the last tau + 1 music rows. Call Advance, Fill and Finish for each frame; they allocate
/// nothing.
class TransitionWindow {
 public:
  TransitionWindow(const ModelInfo& model, int audio_features, const TransitionSpec& spec);

  /// Moves to the next frame. `previous`: the pose before it; null for the first.
  void Advance(const Pose* previous);
  /// Sets the inputs of the frame, which point into this window and are valid until the next
  /// Advance.
  void Fill(FlowFrame* frame) const;
  /// Decodes the frame that the model has made.
  const PoseCodec::Decoded& Finish(const FlowFrame& frame);

 private:
  Eigen::Map<Eigen::VectorXf> PastRow(int row) {
    return {past_.data() + static_cast<std::ptrdiff_t>(row) * codec_.width(), codec_.width()};
  }

  const ModelInfo* model_;
  PoseCodec codec_;
  std::vector<float> past_;   // [tau, width], oldest first
  std::vector<float> audio_;  // [tau + 1, audio_features]
  std::optional<MusicRows> music_;

  int frame_ = 0;
  const TransitionNoise noise_;
  Pose last_;  // the previous frame
  JointPlacement last_placement_;
  ContactDetector contacts_;

  // Kept for their memory.
  JointPlacement placement_;
  PoseCodec::Decoded decoded_;
};

TransitionWindow::TransitionWindow(const ModelInfo& model, int audio_features,
                                   const TransitionSpec& spec)
    : model_(&model),
      codec_(model.skeleton),
      past_(static_cast<size_t>(model.history_frames * codec_.width())),
      audio_(static_cast<size_t>((model.history_frames + 1) * audio_features)),
      music_(model.music_features ? spec.music : std::nullopt),
      noise_(spec),
      last_(spec.history.back()),
      contacts_(model.skeleton) {
  const int tau = model.history_frames;
  std::vector<JointPlacement> placements;
  for (const Pose& pose : spec.history)
    placements.push_back(ForwardKinematics(model.skeleton, pose));
  for (int t = 0; t < tau; ++t) {
    // The first frame takes its velocity from the next step.
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
  if (music_) Eigen::Map<Eigen::MatrixXf>(audio_.data(), audio_features, tau) = music_->history;
}

void TransitionWindow::Advance(const Pose* previous) {
  if (previous != nullptr) {
    std::copy(past_.begin() + codec_.width(), past_.end(), past_.begin());
    ForwardKinematics(model_->skeleton, *previous, placement_);
    contacts_.Next(last_placement_.positions, placement_.positions, model_->fps);
    codec_.Encode(*previous, last_, contacts_.contacts(), model_->fps,
                  PastRow(model_->history_frames - 1));
    last_ = *previous;
    std::swap(last_placement_, placement_);
  }
  if (music_) {
    const std::ptrdiff_t row = music_->rows.rows();
    // Before frame 0 the last row is still free.
    if (frame_ > 0) std::copy(audio_.begin() + row, audio_.end(), audio_.begin());
    std::copy_n(music_->rows.col(frame_).data(), row, audio_.end() - row);
  }
}

void TransitionWindow::Fill(FlowFrame* frame) const {
  frame->frame = frame_;
  frame->past = past_;
  frame->audio = audio_;
  frame->has_audio = music_.has_value();
  frame->noise = &noise_;
}

const PoseCodec::Decoded& TransitionWindow::Finish(const FlowFrame& frame) {
  codec_.Decode(Eigen::Map<const Eigen::VectorXf>(frame.features.data(), codec_.width()), decoded_);
  ++frame_;
  return decoded_;
}

AutoregressiveFlowSampler::AutoregressiveFlowSampler(ModelInfo info, FlowConfig config,
                                                     std::string device, MakeStepper make_stepper)
    : Sampler(std::move(info), std::move(device)),
      config_(std::move(config)),
      make_stepper_(std::move(make_stepper)) {}

Slices<Plan> AutoregressiveFlowSampler::Sample(const ValidSpec& valid) {
  const TransitionSpec& spec = *valid;
  const PoseCodec codec(model_.skeleton);
  const std::unique_ptr<FlowStepper> stepper = make_stepper_();
  stepper->StartTransition(KeyConditions(config_, codec.joints(), codec.width(), spec.frames,
                                         spec.target ? &spec.target->pose : nullptr,
                                         spec.target ? spec.target->mask : PoseMask{}));
  TransitionWindow window(model_, config_.audio_features, spec);
  std::optional<Arrival> arrival = ArrivalOf(spec);
  std::vector<float> features(static_cast<size_t>(codec.width()));
  FlowFrame frame;
  frame.features = features;
  const auto frames = static_cast<size_t>(spec.frames);
  Plan plan;
  plan.poses.reserve(frames);
  plan.contacts.reserve(frames);
  plan.log_likelihoods.reserve(frames);
  Pose steered;  // the previous frame, after arrival
  for (size_t at = 0; at < frames; ++at) {
    window.Advance(at == 0 ? nullptr : &steered);
    window.Fill(&frame);
    stepper->Step(&frame);
    const PoseCodec::Decoded& drawn = window.Finish(frame);
    Contacts& contacts = plan.contacts.emplace_back();
    for (size_t foot = 0; foot < contacts.size(); ++foot)
      contacts[foot] = std::clamp(drawn.contacts[foot], 0.0F, 1.0F);
    if (frame.log_likelihood) plan.log_likelihoods.push_back(*frame.log_likelihood);
    plan.poses.push_back(drawn.pose);
    steered = arrival ? arrival->Apply(drawn.pose) : drawn.pose;
    co_await Pause();
  }
  co_return plan;
}

}  // namespace choreo
