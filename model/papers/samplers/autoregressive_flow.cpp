#include "model/papers/samplers/autoregressive_flow.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/motion/contacts.h"
#include "model/motion/kinematics.h"
#include "model/motion/pose_codec.h"
#include "model/papers/networks/key_condition.h"

namespace choreo {
namespace {

/// The flow's inputs from a transition: the features of the last tau frames as arrival has steered
/// them, and the last tau + 1 music rows. Call Advance, Fill and Finish for each frame; they
/// allocate nothing.
class TransitionWindow {
 public:
  TransitionWindow(const ModelInfo& model, const TransitionSpec& spec);

  /// Moves on to the next frame. `previous`: the frame danced before it; null for the first.
  void Advance(const Pose* previous);
  /// The inputs of the frame; they point into this window and are valid until the next Advance.
  void Fill(FlowFrame* frame) const;
  /// The frame as the model has made it.
  const PoseCodec::Decoded& Finish(const FlowFrame& frame);

 private:
  Eigen::Map<Eigen::VectorXf> PastRow(int row) {
    return {past_.data() + static_cast<std::ptrdiff_t>(row) * codec_.width(), codec_.width()};
  }

  const ModelInfo* model_;
  PoseCodec codec_;
  std::vector<float> past_;   // [tau, width], oldest first
  std::vector<float> audio_;  // [tau + 1, audio_features]
  std::optional<PaperInputs::Music> music_;

  int frame_ = 0;
  FrameNoise noise_;           // the frame's
  std::vector<int64_t> like_;  // TransitionSpec::noise_like
  Pose last_;                  // the previous frame
  JointPlacement last_placement_;
  ContactDetector contacts_;

  // Kept for their memory.
  JointPlacement placement_;
  PoseCodec::Decoded decoded_;
};

TransitionWindow::TransitionWindow(const ModelInfo& model, const TransitionSpec& spec)
    : model_(&model),
      codec_(model.skeleton),
      past_(static_cast<size_t>(model.history_frames * codec_.width())),
      audio_(static_cast<size_t>((model.history_frames + 1) * model.audio_features)),
      music_(model.hears_music ? spec.paper.music : std::nullopt),
      noise_{.seed = spec.seed,
             .frame = spec.first_frame,
             .candidate = spec.candidate,
             .spread = spec.temperature,
             .variation = spec.variation},
      like_(spec.noise_like),
      last_(spec.history.back()),
      contacts_(model.skeleton) {
  const int tau = model.history_frames;
  std::vector<JointPlacement> placements;
  for (const Pose& pose : spec.history)
    placements.push_back(ForwardKinematics(model.skeleton, pose));
  for (int t = 0; t < tau; ++t) {
    // The first frame takes its speed from the next step.
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
  if (music_)
    Eigen::Map<Eigen::MatrixXf>(audio_.data(), model.audio_features, tau) = music_->history;
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
    const int row = model_->audio_features;
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
  frame->noise = noise_;
  frame->noise.like = like_.empty() ? noise_.frame : like_[static_cast<size_t>(frame_)];
}

const PoseCodec::Decoded& TransitionWindow::Finish(const FlowFrame& frame) {
  codec_.Decode(Eigen::Map<const Eigen::VectorXf>(frame.features.data(), codec_.width()), decoded_);
  ++frame_;
  ++noise_.frame;
  return decoded_;
}

class FlowSampling : public Sampling {
 public:
  FlowSampling(const ModelInfo& model, const FlowConfig& config, const TransitionSpec& spec,
               std::unique_ptr<FlowStepper> stepper)
      : window_(model, spec),
        arrival_(spec.paper.arrival),
        frames_(static_cast<size_t>(spec.frames)),
        stepper_(std::move(stepper)),
        features_(static_cast<size_t>(PoseCodec(model.skeleton).width())) {
    const PoseCodec codec(model.skeleton);
    stepper_->Begin(KeyConditions(config, codec.joints(), codec.width(), spec.frames,
                                  spec.target ? &spec.target->pose : nullptr,
                                  spec.target ? spec.target->mask : PoseMask{}));
    frame_.features = features_;
    plan_.poses.reserve(frames_);
    plan_.contacts.reserve(frames_);
    plan_.log_likelihoods.reserve(frames_);
  }

  bool Continue() override {
    window_.Advance(plan_.poses.empty() ? nullptr : &steered_);
    window_.Fill(&frame_);
    stepper_->Step(&frame_);
    const PoseCodec::Decoded& drawn = window_.Finish(frame_);
    Contacts& contacts = plan_.contacts.emplace_back();
    for (size_t foot = 0; foot < contacts.size(); ++foot)
      contacts[foot] = std::clamp(drawn.contacts[foot], 0.0F, 1.0F);
    if (frame_.log_likelihood) plan_.log_likelihoods.push_back(*frame_.log_likelihood);
    plan_.poses.push_back(drawn.pose);
    steered_ = arrival_ ? arrival_->Apply(drawn.pose) : drawn.pose;
    return plan_.poses.size() < frames_;
  }

 private:
  TransitionWindow window_;
  std::optional<Arrival> arrival_;
  size_t frames_;
  std::unique_ptr<FlowStepper> stepper_;
  std::vector<float> features_;  // of the frame
  FlowFrame frame_;
  Pose steered_;  // the previous frame
};

}  // namespace

AutoregressiveFlowSampler::AutoregressiveFlowSampler(ModelInfo info, FlowConfig config,
                                                     std::string device, MakeStepper make_stepper)
    : Sampler(std::move(info), std::move(device)),
      config_(std::move(config)),
      make_stepper_(std::move(make_stepper)) {}

std::unique_ptr<Sampling> AutoregressiveFlowSampler::BeginValid(const TransitionSpec& spec) {
  return std::make_unique<FlowSampling>(model_, config_, spec, make_stepper_());
}

}  // namespace choreo
