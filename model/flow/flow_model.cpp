#include "model/flow/flow_model.h"

#include <torch/torch.h>

#include <cmath>
#include <numbers>

#include "model/flow/key_condition.h"
#include "model/flow/torch_kinematics.h"
#include "model/motion/pose_codec.h"
#include "model/motion/rotation.h"

namespace choreo {

using torch::Tensor;

namespace {

Tensor BoundSample(const Tensor& x) {
  const Tensor inside = x.clamp(-kSampleBound, kSampleBound);
  return inside + (x - inside).tanh();
}

// log |dy/dx| of that, summed over features: -2 log cosh of what lies beyond the bound.
Tensor BoundLogDet(const Tensor& x) {
  const Tensor beyond = (x.abs() - kSampleBound).clamp_min(0);
  return -2 * (beyond + torch::log1p((-2 * beyond).exp()) - std::numbers::ln2).sum(-1);
}

}  // namespace

FlowModelImpl::FlowModelImpl(const FlowConfig& config, const Skeleton& skeleton)
    : config_(config), skeleton_(skeleton), width_(PoseCodec(skeleton).width()) {
  feature_mean_ = register_buffer("feature_mean", torch::zeros({width_}));
  feature_std_ = register_buffer("feature_std", torch::ones({width_}));
  audio_mean_ = register_buffer("audio_mean", torch::zeros({config.audio_features}));
  audio_std_ = register_buffer("audio_std", torch::ones({config.audio_features}));
  const int past = config.history_frames * width_;
  const int audio = config.HeardWidth() + 1;
  const int fixed = key_width();
  int condition = past + audio + fixed;
  if (config.condition_width > 0) {
    condition = config.condition_width;
    encode_past_ = register_module("encode_past", torch::nn::Linear(past, condition));
    encode_static_ = register_module("encode_static", torch::nn::Linear(fixed, condition));
    encode_audio_ = register_module("encode_audio", torch::nn::Linear(audio, condition));
    encode_ = register_module("encode", torch::nn::Linear(condition, condition));
  }
  flow_ = register_module("flow", CouplingFlow(width_, condition, config));
}

int FlowModelImpl::key_width() const { return KeyConditionWidth(skeleton_.joints(), width_); }

Tensor FlowModelImpl::Begin(const TransitionTensors& transition) {
  const auto here = [](const Tensor& tensor) {
    return tensor.detach().to(torch::kCPU, torch::kFloat64).contiguous();
  };
  const Tensor places = here(transition.target_position), turns = here(transition.target_rotation),
               masks = here(transition.target_mask);
  const int joints = skeleton_.joints();
  const Tensor conditions = torch::empty({places.size(0), transition.frames, key_width()});
  for (int64_t row = 0; row < places.size(0); ++row) {
    const double* turn = turns.data_ptr<double>() + row * 9 * joints;
    const double* asked = masks.data_ptr<double>() + row * (joints + 1);
    Pose key{Eigen::Vector3d(places.data_ptr<double>() + row * 3), Eigen::Matrix3Xd(3, joints)};
    PoseMask mask{.root_position = asked[joints] > 0, .joints = {}};
    for (int j = 0; j < joints; ++j) {
      using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
      key.rotations.col(j) = LogMap(Eigen::Map<const Matrix>(turn + 9L * j));
      mask.joints.push_back(asked[j] > 0);
    }
    const int frames = static_cast<int>(transition.frames);
    Eigen::Map<Eigen::MatrixXf>(conditions[row].data_ptr<float>(), key_width(), frames) =
        KeyConditions(config_, joints, width_, frames, &key, mask);
  }
  return Encode(conditions.to(transition.target_position.device()));
}

Tensor FlowModelImpl::Encode(const Tensor& conditions) {
  return config_.condition_width > 0 ? encode_static_(conditions) : conditions;
}

Tensor FlowModelImpl::Standardise(const Tensor& features) const {
  return (features - feature_mean_) / feature_std_;
}

Tensor FlowModelImpl::StandardiseAudio(const Tensor& audio, const Tensor& has_audio) const {
  return ((audio - audio_mean_) / audio_std_).clamp(-kFeatureClamp, kFeatureClamp) *
         has_audio.unsqueeze(-1);
}

Tensor FlowModelImpl::Condition(const Tensor& past, const Tensor& audio,
                                const Tensor& static_condition) {
  if (config_.condition_width == 0) return torch::cat({past, audio, static_condition}, -1);
  return torch::silu(
      encode_(torch::silu(encode_past_(past) + encode_audio_(audio) + static_condition)));
}

Tensor FlowModelImpl::LiveCondition(const Tensor& past, const Tensor& audio,
                                    const Tensor& has_audio, const Tensor& static_condition) {
  const Tensor clamped = Standardise(past).clamp(-kFeatureClamp, kFeatureClamp).flatten(1);
  const Tensor rows = torch::cat({StandardiseAudio(audio, has_audio).flatten(1), has_audio}, 1);
  return Condition(clamped, rows, static_condition).unsqueeze(1);
}

FlowModelImpl::StepResult FlowModelImpl::Step(const Tensor& past, const Tensor& audio,
                                              const Tensor& has_audio,
                                              const Tensor& static_condition, const Tensor& noise,
                                              const std::vector<Tensor>& inverse_weights,
                                              FlowState* state) {
  const Tensor condition = LiveCondition(past, audio, has_audio, static_condition);
  Tensor log_det = torch::zeros({noise.size(0), 1}, noise.options());
  const Tensor x =
      flow_->Inverse(noise.unsqueeze(1), condition, inverse_weights, state, &log_det).squeeze(1);
  const double log_two_pi = std::log(2 * M_PI);
  const Tensor base = -0.5 * (noise.square().sum(1) + log_two_pi * width_);
  return {BoundSample(x) * feature_std_ + feature_mean_,
          base + log_det.squeeze(1) - BoundLogDet(x)};
}

std::pair<Tensor, Tensor> FlowModelImpl::Windows(const Tensor& features, const Tensor& audio,
                                                 const Tensor& has_audio,
                                                 const Tensor& static_condition) {
  const int64_t tau = config_.history_frames, batch = features.size(0);
  const int64_t frames = features.size(1) - tau;
  const Tensor standard = Standardise(features);
  const Tensor clamped = standard.clamp(-kFeatureClamp, kFeatureClamp);
  // unfold: [batch, N + 1, width, tau], of which the last window has no frame behind it.
  Tensor past = clamped.unfold(1, tau, 1).narrow(1, 0, frames).transpose(2, 3);
  if (is_training()) {
    if (config_.history_noise > 0) past = past + config_.history_noise * torch::randn_like(past);
    // Whole frames are dropped, and the rest is not scaled up: at sampling time all are there (the
    // encoder sees both).
    const Tensor keep =
        (torch::rand({batch, frames, tau, 1}, past.options()) >= config_.history_dropout)
            .to(past.dtype());
    past = past * keep;
  }
  const Tensor rows =
      StandardiseAudio(audio, has_audio).unfold(1, tau + 1, 1).transpose(2, 3).flatten(2);
  const Tensor flag = has_audio.unsqueeze(1).expand({batch, frames, 1});
  return {standard.narrow(1, tau, frames),
          Condition(past.reshape({batch, frames, tau * width_}), torch::cat({rows, flag}, -1),
                    static_condition)};
}

Tensor FlowModelImpl::LogLikelihood(const Tensor& features, const Tensor& audio,
                                    const Tensor& has_audio, const Tensor& static_condition) {
  const auto [x, condition] = Windows(features, audio, has_audio, static_condition);
  FlowState state = flow_->InitialState(x.size(0));
  Tensor log_det = torch::zeros({x.size(0), x.size(1)}, x.options());
  const Tensor z = flow_->Forward(x, condition, &state, &log_det);
  return -0.5 * (z.square().sum(-1) + std::log(2 * M_PI) * width_) + log_det;
}

void FlowModelImpl::InitialiseActNorm(const Tensor& features, const Tensor& audio,
                                      const Tensor& has_audio, const Tensor& static_condition) {
  torch::NoGradGuard no_grad;
  const auto [x, condition] = Windows(features, audio, has_audio, static_condition);
  flow_->InitialiseActNorm(x, condition);
}

TrajectoryTensors FlowModelImpl::Decode(const Tensor& features) const {
  const int64_t joints = skeleton_.joints();
  return {features.narrow(-1, 0, 3),
          ExpMapBatch(features.narrow(-1, 3, 3 * joints)
                          .reshape({features.size(0), features.size(1), joints, 3}))};
}

Tensor FlowModelImpl::Rollout(const Tensor& history, const Tensor& audio, const Tensor& has_audio,
                              const Tensor& static_condition, const Tensor& noise) {
  const int64_t tau = config_.history_frames, frames = noise.size(1);
  const std::vector<Tensor> inverse_weights = InverseWeights();
  std::vector<CouplingState> states = flow_->Split(flow_->InitialState(noise.size(0)));
  std::vector<Tensor> past = history.unbind(1);
  for (int64_t t = 0; t < frames; ++t) {
    const std::vector<Tensor> window(past.end() - tau, past.end());
    const Tensor condition = LiveCondition(torch::stack(window, 1), audio.narrow(1, t, tau + 1),
                                           has_audio, static_condition.select(1, t));
    const Tensor x =
        flow_->Inverse(noise.narrow(1, t, 1), condition, inverse_weights, &states, nullptr);
    past.push_back(BoundSample(x.squeeze(1)) * feature_std_ + feature_mean_);
  }
  return torch::stack(std::vector<Tensor>(past.begin() + tau, past.end()), 1);
}

void FlowModelImpl::SetFeatureNormalisation(const Tensor& mean, const Tensor& std) {
  torch::NoGradGuard no_grad;
  feature_mean_.copy_(mean);
  feature_std_.copy_(std);
}

void FlowModelImpl::SetAudioNormalisation(const Tensor& mean, const Tensor& std) {
  torch::NoGradGuard no_grad;
  audio_mean_.copy_(mean);
  audio_std_.copy_(std);
}

}  // namespace choreo
