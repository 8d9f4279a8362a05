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

/// What the flow sees of a transition: the features of the last tau frames as arrival has steered
/// them, and the last tau + 1 music rows. Per frame: Advance, FillRow, Finish; nothing allocates
/// there.
class TransitionWindow {
 public:
  TransitionWindow(const ModelInfo& model, const TransitionSpec& spec);

  /// Moves the windows on to the next frame, behind what was danced before it (null: nothing).
  void Advance(const Pose* previous);
  /// What the frame is made of. It looks into this window, until the next Advance.
  void FillRow(FlowRow* row) const;
  /// What the model made of that row.
  const PoseCodec::Decoded& Finish(const FlowRow& row);

 private:
  Eigen::Map<Eigen::VectorXf> PastRow(int row) {
    return {past_.data() + static_cast<std::ptrdiff_t>(row) * codec_.width(), codec_.width()};
  }

  const ModelInfo* model_;
  PoseCodec codec_;
  std::vector<float> past_;   // [tau, width], oldest first
  std::vector<float> audio_;  // [tau + 1, audio_features]
  bool hears_;
  Eigen::MatrixXf audio_rows_;

  int frame_ = 0;
  FrameNoise noise_;           // of the frame
  std::vector<int64_t> like_;  // TransitionSpec::noise_like
  Pose last_;                  // danced before it
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
      hears_(spec.has_audio && model.hears_music),
      audio_rows_(spec.audio_rows),
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
  if (hears_)
    Eigen::Map<Eigen::MatrixXf>(audio_.data(), model.audio_features, tau) = spec.audio_history;
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
  if (hears_) {
    const int row = model_->audio_features;
    // The last row was left free for frame 0's.
    if (frame_ > 0) std::copy(audio_.begin() + row, audio_.end(), audio_.begin());
    std::copy_n(audio_rows_.col(frame_).data(), row, audio_.end() - row);
  }
}

void TransitionWindow::FillRow(FlowRow* row) const {
  row->frame = frame_;
  row->past = past_;
  row->audio = audio_;
  row->has_audio = hears_;
  row->noise = noise_;
  row->noise.like = like_.empty() ? noise_.frame : like_[static_cast<size_t>(frame_)];
}

const PoseCodec::Decoded& TransitionWindow::Finish(const FlowRow& row) {
  codec_.Decode(Eigen::Map<const Eigen::VectorXf>(row.features.data(), codec_.width()), decoded_);
  ++frame_;
  ++noise_.frame;
  return decoded_;
}

class FlowSampling : public Sampling {
 public:
  FlowSampling(const ModelInfo& model, const FlowConfig& config, const TransitionSpec& spec,
               std::unique_ptr<FlowTile> tile)
      : window_(model, spec),
        arrival_(spec.arrival),
        frames_(static_cast<size_t>(spec.frames)),
        tile_(std::move(tile)),
        features_(static_cast<size_t>(PoseCodec(model.skeleton).width())) {
    const PoseCodec codec(model.skeleton);
    tile_->Begin(0, KeyConditions(config, codec.joints(), codec.width(), spec.frames,
                                  spec.target ? &spec.target->pose : nullptr,
                                  spec.target ? spec.target->mask : PoseMask{}));
    row_.features = features_;
    plan_.poses.reserve(frames_);
    plan_.contacts.reserve(frames_);
    plan_.log_likelihoods.reserve(frames_);
  }

  bool Continue() override {
    window_.Advance(plan_.poses.empty() ? nullptr : &steered_);
    window_.FillRow(&row_);
    tile_->Run({&row_, 1});
    const PoseCodec::Decoded& drawn = window_.Finish(row_);
    Contacts& contacts = plan_.contacts.emplace_back();
    for (size_t foot = 0; foot < contacts.size(); ++foot)
      contacts[foot] = std::clamp(drawn.contacts[foot], 0.0F, 1.0F);
    if (row_.log_likelihood) plan_.log_likelihoods.push_back(*row_.log_likelihood);
    plan_.poses.push_back(drawn.pose);
    steered_ = arrival_ ? arrival_->Apply(drawn.pose) : drawn.pose;
    return plan_.poses.size() < frames_;
  }

 private:
  TransitionWindow window_;
  std::optional<Arrival> arrival_;
  size_t frames_;
  std::unique_ptr<FlowTile> tile_;
  std::vector<float> features_;  // of the frame
  FlowRow row_;
  Pose steered_;  // the frame before
};

}  // namespace

AutoregressiveFlowSampler::AutoregressiveFlowSampler(ModelInfo info, FlowConfig config,
                                                     std::string device, MakeTile make_tile)
    : Sampler(std::move(info), std::move(device)),
      config_(std::move(config)),
      make_tile_(std::move(make_tile)) {}

std::unique_ptr<Sampling> AutoregressiveFlowSampler::BeginValid(const TransitionSpec& spec) {
  return std::make_unique<FlowSampling>(model_, config_, spec, make_tile_());
}

}  // namespace choreo
