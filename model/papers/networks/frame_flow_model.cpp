#include "model/papers/networks/frame_flow_model.h"

#include <torch/nn/modules/linear.h>
#include <torch/utils.h>

#include <cmath>
#include <numbers>

#include "model/core/error.h"
#include "model/motion/pose/pose_codec.h"
#include "model/papers/networks/key_condition.h"

namespace choreo {

using torch::Tensor;

namespace {

constexpr double kRidge = 1e-6;  // in fits of standardised features

Tensor BoundSample(const Tensor& x) {
  const Tensor inside = x.clamp(-kSampleBound, kSampleBound);
  return inside + (x - inside).tanh();
}

// log |dy/dx| of the bound, summed over features: -2 log cosh of the excess over the bound.
Tensor BoundLogDet(const Tensor& x) {
  const Tensor beyond = (x.abs() - kSampleBound).clamp_min(0);
  return -2 * (beyond + torch::log1p((-2 * beyond).exp()) - std::numbers::ln2).sum(-1);
}

}  // namespace

FlowModelImpl::FlowModelImpl(const FlowConfig& config, const Skeleton& skeleton)
    : config_(config), skeleton_(skeleton), width_(PoseCodec(skeleton).width()) {
  feature_mean_ = register_buffer("feature_mean", torch::zeros({width_}));
  feature_std_ = register_buffer("feature_std", torch::ones({width_}));
  predict_ = torch::zeros({config.history_frames, width_});
  drawn_spread_ = torch::ones({width_});
  if (config.innovations) {
    if (config.condition_width == 0)
      throw InvalidArgument("condition_width", "0, but innovations want a shared encoding");
    predict_ = register_buffer("predict", predict_);
    drawn_spread_ = register_buffer("drawn_spread", drawn_spread_);
  }
  audio_mean_ = register_buffer("audio_mean", torch::zeros({config.audio_features}));
  audio_std_ = register_buffer("audio_std", torch::ones({config.audio_features}));
  const int past = config.history_frames * width_;
  const int audio = config.HeardWidth() + 1;
  const int fixed = key_width() - (config.innovations ? 1 : 0);
  int condition = past + audio + fixed;
  if (config.condition_width > 0) {
    condition = config.condition_width;
    encode_past_ = register_module("encode_past", torch::nn::Linear(past, condition));
    encode_static_ = register_module("encode_static", torch::nn::Linear(fixed, condition));
    encode_audio_ = register_module("encode_audio", torch::nn::Linear(audio, condition));
    encode_ = register_module("encode", torch::nn::Linear(condition, condition));
  }
  if (config.innovations) condition += pose_width();
  flow_ = register_module("flow", CouplingFlow(width_, condition, config));
}

int FlowModelImpl::key_width() const {
  return KeyConditionWidth(config_, skeleton_.joints(), width_);
}

int FlowModelImpl::static_width() const {
  if (config_.condition_width == 0) return key_width();
  return config_.condition_width + (config_.innovations ? 2 * pose_width() + 1 : 0);
}

Tensor FlowModelImpl::StaticCondition(const TransitionTensors& transition) {
  return Encode(KeyConditionTensors(config_, skeleton_, transition));
}

Tensor FlowModelImpl::Encode(const Tensor& conditions) {
  if (config_.condition_width == 0) return conditions;
  if (!config_.innovations) return encode_static_(conditions);
  // The standardised key, its mask, and the frames left follow the encoding.
  const int64_t pose = pose_width(), joints = skeleton_.joints(), left_at = key_width() - 1;
  const Tensor key = (conditions.narrow(-1, 0, pose) - feature_mean_.narrow(0, 0, pose)) /
                     feature_std_.narrow(0, 0, pose);
  const Tensor mask =
      torch::cat({conditions.narrow(-1, pose + joints, 1), conditions.narrow(-1, pose, joints)}, -1)
          .repeat_interleave(3, -1);
  return torch::cat({encode_static_(conditions.narrow(-1, 0, left_at)), key, mask,
                     conditions.narrow(-1, left_at, 1)},
                    -1);
}

Tensor FlowModelImpl::Aim(const Tensor& past, const Tensor& static_condition) const {
  const int64_t pose = pose_width(), at = config_.condition_width;
  const Tensor key = static_condition.narrow(-1, at, pose);
  const Tensor mask = static_condition.narrow(-1, at + pose, pose);
  const Tensor left = static_condition.narrow(-1, at + 2 * pose, 1);
  const Tensor last = past.select(-2, config_.history_frames - 1).narrow(-1, 0, pose);
  const Tensor before = past.select(-2, config_.history_frames - 2).narrow(-1, 0, pose);
  const Tensor way = key - last;
  // If the number of frames left is unknown, aims with the distance alone.
  const Tensor aim = torch::where(left > 0,
                                  AccelerationTo<Tensor>(way, last - before, left.clamp_min(1)) /
                                      drawn_spread_.narrow(0, 0, pose),
                                  way);
  return mask * aim.clamp(-kFeatureClamp, kFeatureClamp);
}

Tensor FlowModelImpl::Standardise(const Tensor& features) const {
  return (features - feature_mean_) / feature_std_;
}

Tensor FlowModelImpl::Drawn(const Tensor& frames, const Tensor& past) const {
  return config_.innovations ? (frames - (predict_ * past).sum(-2)) / drawn_spread_ : frames;
}

Tensor FlowModelImpl::FrameOf(const Tensor& drawn, const Tensor& past) const {
  return config_.innovations ? drawn * drawn_spread_ + (predict_ * past).sum(-2) : drawn;
}

Tensor FlowModelImpl::DrawnSpread() const {
  return config_.innovations ? feature_std_ * drawn_spread_ : feature_std_;
}

Tensor FlowModelImpl::StandardiseAudio(const Tensor& audio, const Tensor& has_audio) const {
  return ((audio - audio_mean_) / audio_std_).clamp(-kFeatureClamp, kFeatureClamp) *
         has_audio.unsqueeze(-1);
}

Tensor FlowModelImpl::Condition(const Tensor& past, const Tensor& seen, const Tensor& audio,
                                const Tensor& static_condition) {
  const Tensor flat = seen.flatten(-2);
  if (config_.condition_width == 0) return torch::cat({flat, audio, static_condition}, -1);
  const Tensor fixed = static_condition.narrow(-1, 0, config_.condition_width);
  const Tensor encoded =
      torch::silu(encode_(torch::silu(encode_past_(flat) + encode_audio_(audio) + fixed)));
  return config_.innovations ? torch::cat({encoded, Aim(past, static_condition)}, -1) : encoded;
}

Tensor FlowModelImpl::LiveCondition(const Tensor& past, const Tensor& audio,
                                    const Tensor& has_audio, const Tensor& static_condition) {
  const Tensor standard = Standardise(past);
  const Tensor rows = torch::cat({StandardiseAudio(audio, has_audio).flatten(1), has_audio}, 1);
  return Condition(standard, standard.clamp(-kFeatureClamp, kFeatureClamp), rows, static_condition)
      .unsqueeze(1);
}

FlowModelImpl::StepResult FlowModelImpl::Step(const Tensor& past, const Tensor& audio,
                                              const Tensor& has_audio,
                                              const Tensor& static_condition, const Tensor& noise,
                                              const std::vector<Tensor>& inverse_weights,
                                              FlowState* state) {
  const Tensor condition = LiveCondition(past, audio, has_audio, static_condition);
  Tensor log_det = torch::zeros({noise.size(0), 1}, noise.options());
  const Tensor drawn =
      flow_->Inverse(noise.unsqueeze(1), condition, inverse_weights, state, &log_det).squeeze(1);
  const Tensor x = FrameOf(drawn, Standardise(past));
  const double log_two_pi = std::log(2 * M_PI);
  const Tensor base = -0.5 * (noise.square().sum(1) + log_two_pi * width_);
  return {BoundSample(x) * feature_std_ + feature_mean_,
          base + log_det.squeeze(1) - DrawnLogDet() - BoundLogDet(x)};
}

std::pair<Tensor, Tensor> FlowModelImpl::Windows(const Tensor& features, const Tensor& audio,
                                                 const Tensor& has_audio,
                                                 const Tensor& static_condition) {
  const int64_t tau = config_.history_frames, batch = features.size(0);
  const int64_t frames = features.size(1) - tau;
  const Tensor standard = Standardise(features);
  // unfold: [batch, N + 1, width, tau]; drop the last window, which has no frame after it.
  const Tensor past = standard.unfold(1, tau, 1).narrow(1, 0, frames).transpose(2, 3);
  Tensor seen = past.clamp(-kFeatureClamp, kFeatureClamp);
  if (is_training()) {
    if (config_.history_noise > 0) seen = seen + config_.history_noise * torch::randn_like(seen);
    // Drops whole frames without scaling up the rest, because sampling has all of them and the
    // encoder learns both cases.
    const Tensor keep =
        (torch::rand({batch, frames, tau, 1}, seen.options()) >= config_.history_dropout)
            .to(seen.dtype());
    seen = seen * keep;
  }
  const Tensor rows =
      StandardiseAudio(audio, has_audio).unfold(1, tau + 1, 1).transpose(2, 3).flatten(2);
  const Tensor flag = has_audio.unsqueeze(1).expand({batch, frames, 1});
  return {Drawn(standard.narrow(1, tau, frames), past),
          Condition(past, seen, torch::cat({rows, flag}, -1), static_condition)};
}

Tensor FlowModelImpl::LogLikelihood(const Tensor& features, const Tensor& audio,
                                    const Tensor& has_audio, const Tensor& static_condition) {
  const auto [x, condition] = Windows(features, audio, has_audio, static_condition);
  FlowState state = flow_->InitialState(x.size(0));
  Tensor log_det = torch::zeros({x.size(0), x.size(1)}, x.options());
  const Tensor z = flow_->Forward(x, condition, &state, &log_det);
  return -0.5 * (z.square().sum(-1) + std::log(2 * M_PI) * width_) + log_det - DrawnLogDet();
}

void FlowModelImpl::InitialiseActNorm(const Tensor& features, const Tensor& audio,
                                      const Tensor& has_audio, const Tensor& static_condition) {
  torch::NoGradGuard no_grad;
  const auto [x, condition] = Windows(features, audio, has_audio, static_condition);
  flow_->InitialiseActNorm(x, condition);
}

Tensor FlowModelImpl::Rollout(const Tensor& history, const Tensor& audio, const Tensor& has_audio,
                              const Tensor& static_condition, const Tensor& noise) {
  const int64_t tau = config_.history_frames, frames = noise.size(1);
  const std::vector<Tensor> inverse_weights = InverseWeights();
  std::vector<CouplingState> states = flow_->Split(flow_->InitialState(noise.size(0)));
  std::vector<Tensor> past = history.unbind(1);
  for (int64_t t = 0; t < frames; ++t) {
    const Tensor window = torch::stack(std::vector<Tensor>(past.end() - tau, past.end()), 1);
    const Tensor condition = LiveCondition(window, audio.narrow(1, t, tau + 1), has_audio,
                                           static_condition.select(1, t));
    const Tensor drawn =
        flow_->Inverse(noise.narrow(1, t, 1), condition, inverse_weights, &states, nullptr);
    const Tensor x = FrameOf(drawn.squeeze(1), Standardise(window));
    past.push_back(BoundSample(x) * feature_std_ + feature_mean_);
  }
  return torch::stack(std::vector<Tensor>(past.begin() + tau, past.end()), 1);
}

void FlowModelImpl::SetFeatureNormalisation(const Tensor& mean, const Tensor& std) {
  torch::NoGradGuard no_grad;
  feature_mean_.copy_(mean);
  feature_std_.copy_(std);
}

void FlowModelImpl::FitPrediction(const Tensor& windows, const Tensor& floor) {
  torch::NoGradGuard no_grad;
  const int64_t tau = config_.history_frames;
  // [width, n, tau] and [width, n, 1]; features that never move are predicted to stay constant.
  const Tensor standard = Standardise(windows).to(torch::kFloat64).permute({2, 0, 1});
  const Tensor past = standard.narrow(2, 0, tau), now = standard.narrow(2, tau, 1);
  const Tensor across = past.transpose(1, 2);
  const Tensor ridge =
      kRidge * static_cast<double>(past.size(1)) * torch::eye(tau, torch::kFloat64);
  const Tensor weights =
      torch::linalg_solve(torch::matmul(across, past) + ridge, torch::matmul(across, now));
  predict_.copy_(weights.squeeze(2).t());
  const Tensor left = now - torch::matmul(past, weights);
  drawn_spread_.copy_(
      torch::maximum(left.square().mean({1, 2}).sqrt().to(torch::kFloat32), floor / feature_std_));
}

void FlowModelImpl::SetAudioNormalisation(const Tensor& mean, const Tensor& std) {
  torch::NoGradGuard no_grad;
  audio_mean_.copy_(mean);
  audio_std_.copy_(std);
}

}  // namespace choreo
