#include "model/flow/flow_model.h"

#include <torch/torch.h>

#include <cmath>

#include "model/flow/torch_kinematics.h"
#include "model/motion/mirror.h"

namespace choreo {

using torch::Tensor;

namespace {

// Past frames and music beyond this many standard deviations are outliers that training never saw:
// keep them in range.
constexpr double kFeatureClamp = 6.0;
// Sampled frames beyond this many standard deviations bend softly towards one more: what they feed
// back can't run away, and a roll-out that tries to still has a gradient.
constexpr double kSampleBound = 3.0;

Tensor BoundSample(const Tensor& x) {
  const Tensor inside = x.clamp(-kSampleBound, kSampleBound);
  return inside + (x - inside).tanh();
}

// paper F 3.2.1: root 3, rotations, velocities 3, contacts 4.
int FeatureWidth(const Skeleton& skeleton) { return 3 + 3 * skeleton.joints() + 3 + 4; }

}  // namespace

FlowModelImpl::FlowModelImpl(const FlowConfig& config, const Skeleton& skeleton)
    : config_(config), skeleton_(skeleton), width_(FeatureWidth(skeleton)) {
  feature_mean_ = register_buffer("feature_mean", torch::zeros({width_}));
  feature_std_ = register_buffer("feature_std", torch::ones({width_}));
  audio_mean_ = register_buffer("audio_mean", torch::zeros({config.audio_features}));
  audio_std_ = register_buffer("audio_std", torch::ones({config.audio_features}));
  if (config.planner.width > 0) {
    planner_ = register_module("planner", MakePlanner(skeleton.joints(), config.planner));
    if (config.planner.variety > 0)
      variety_ = register_module("variety", Variety(skeleton.joints(), config.planner.variety));
  }
  const std::vector<int> pairs = MirrorPairs(skeleton);
  pairs_ = torch::tensor(std::vector<int64_t>(pairs.begin(), pairs.end()));
  const int joints = skeleton.joints();
  const int past = config.history_frames * width_;
  const int audio = (config.history_frames + 1) * config.audio_features + 1;
  // Key: position, 6D rotations, mask. Then Eq. 9's embedding at the width of the motion, and the
  // planner's hidden state.
  const int fixed = 3 + 6 * joints + joints + 1 + width_ + config.planner.width;
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

int FlowModelImpl::static_width() const {
  const int joints = skeleton_.joints();
  return config_.condition_width > 0 ? config_.condition_width
                                     : 3 + 6 * joints + joints + 1 + width_ + config_.planner.width;
}

TransitionContext FlowModelImpl::Begin(const TransitionTensors& transition, const Tensor& variety) {
  PlannerImpl::Plan plan;
  if (has_planner()) plan = PlanOf(transition);
  if (variety.defined()) plan.trajectory = variety_->Vary(transition, plan.trajectory, variety);
  return Hoist(transition, plan);
}

TransitionContext FlowModelImpl::BeginNear(const TransitionTensors& transition,
                                           const TrajectoryTensors& truth) {
  PlannerImpl::Plan plan;
  if (has_planner()) plan = PlanOf(transition);
  if (variety_) plan.trajectory = variety_->Approach(transition, plan.trajectory, truth);
  return Hoist(transition, plan);
}

PlannerImpl::Plan FlowModelImpl::PlanOf(const TransitionTensors& transition) {
  return planner_->Balanced(transition, pairs_.to(transition.target_position.device()));
}

TransitionContext FlowModelImpl::Hoist(const TransitionTensors& transition,
                                       const PlannerImpl::Plan& plan) {
  const int64_t batch = transition.target_position.size(0), frames = transition.frames;
  const int64_t joints = skeleton_.joints();
  TransitionContext context;
  context.reference = plan.trajectory;
  const Tensor mask =
      config_.keys ? transition.target_mask : torch::zeros_like(transition.target_mask);
  const Tensor present = mask.amax(1, true);  // [batch, 1]
  const Tensor key = torch::cat(
      {transition.target_position * mask.narrow(1, joints, 1),
       (SixDBatch(transition.target_rotation) * mask.narrow(1, 0, joints).unsqueeze(-1)).flatten(1),
       mask},
      1);
  const Tensor since = torch::arange(frames, mask.options());
  const Tensor count = config_.forward_embedding ? since : (frames - 1) - since;
  const Tensor embedding =
      TimeEmbedding(count, width_).unsqueeze(0).expand({batch, frames, width_});
  std::vector<Tensor> parts = {
      key.unsqueeze(1).expand({batch, frames, key.size(1)}),
      config_.time_embedding ? embedding * present.unsqueeze(1) : torch::zeros_like(embedding)};
  if (has_planner()) parts.push_back(plan.hidden);
  context.static_condition = torch::cat(parts, -1);
  if (config_.condition_width > 0) {
    context.static_condition = encode_static_(context.static_condition);
  }
  return context;
}

void FlowModelImpl::RoundNetworks() {
  flow_->RoundNetworks();
  if (config_.condition_width == 0) return;
  for (torch::nn::Linear layer : {encode_past_, encode_audio_, encode_})
    layer->to(torch::kBFloat16);
}

void FlowModelImpl::ForgetFlow() {
  for (Tensor& parameter : flow_->parameters()) parameter.set_data(torch::empty({0}));
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
  const auto inside = encode_->weight.scalar_type(), outside = static_condition.scalar_type();
  const Tensor sum = encode_past_(past.to(inside)).to(outside) +
                     encode_audio_(audio.to(inside)).to(outside) + static_condition;
  return torch::silu(encode_(torch::silu(sum).to(inside)).to(outside));
}

FlowModelImpl::StepResult FlowModelImpl::Step(const Tensor& past, const Tensor& audio,
                                              const Tensor& has_audio,
                                              const Tensor& static_condition, const Tensor& noise,
                                              const std::vector<Tensor>& inverse_weights,
                                              FlowState* state) {
  Tensor clamped = Standardise(past).clamp(-kFeatureClamp, kFeatureClamp);
  if (has_planner()) {
    const Tensor far = clamped.narrow(2, 0, 3 + 3 * skeleton_.joints()).abs().amax(2, true);
    const Tensor most = kStrayed * (1 + noise.square().mean(1).sqrt().view({-1, 1, 1}));
    clamped = clamped * (far < most).to(clamped.dtype());
  }
  clamped = clamped.flatten(1);
  const Tensor rows = torch::cat({StandardiseAudio(audio, has_audio).flatten(1), has_audio}, 1);
  const Tensor condition = Condition(clamped, rows, static_condition).unsqueeze(1);
  Tensor log_det = torch::zeros({noise.size(0), 1}, noise.options());
  const Tensor x =
      flow_->Inverse(noise.unsqueeze(1), condition, inverse_weights, state, &log_det).squeeze(1);
  const double log_two_pi = std::log(2 * M_PI);
  const Tensor base = -0.5 * (noise.square().sum(1) + log_two_pi * width_);
  return {BoundSample(x) * feature_std_ + feature_mean_, base + log_det.squeeze(1)};
}

std::pair<Tensor, Tensor> FlowModelImpl::Windows(const Tensor& features, const Tensor& audio,
                                                 const Tensor& has_audio,
                                                 const TransitionContext& context) {
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
                    context.static_condition)};
}

Tensor FlowModelImpl::LogLikelihood(const Tensor& features, const Tensor& audio,
                                    const Tensor& has_audio, const TransitionContext& context) {
  const auto [x, condition] = Windows(features, audio, has_audio, context);
  FlowState state = flow_->InitialState(x.size(0));
  Tensor log_det = torch::zeros({x.size(0), x.size(1)}, x.options());
  const Tensor z = flow_->Forward(x, condition, &state, &log_det);
  return -0.5 * (z.square().sum(-1) + std::log(2 * M_PI) * width_) + log_det;
}

void FlowModelImpl::InitialiseActNorm(const Tensor& features, const Tensor& audio,
                                      const Tensor& has_audio, const TransitionContext& context) {
  torch::NoGradGuard no_grad;
  const auto [x, condition] = Windows(features, audio, has_audio, context);
  flow_->InitialiseActNorm(x, condition);
}

Tensor FlowModelImpl::RelativeFeatures(const Tensor& absolute, const TrajectoryTensors& truth,
                                       const TransitionContext& context) const {
  if (!context.reference.position.defined()) return absolute;
  const int64_t tau = config_.history_frames, pose_width = 3 + 3 * skeleton_.joints();
  const Tensor move = truth.position - context.reference.position;
  const Tensor turn =
      LogMapBatch(torch::matmul(context.reference.rotation.transpose(-1, -2), truth.rotation));
  const Tensor relative = torch::cat({move, turn.flatten(2)}, -1);
  const Tensor history = torch::zeros({absolute.size(0), tau, pose_width}, absolute.options());
  return torch::cat(
      {torch::cat({history, relative}, 1), absolute.narrow(2, pose_width, width_ - pose_width)},
      -1);
}

TrajectoryTensors FlowModelImpl::Decode(const Tensor& features,
                                        const TransitionContext& context) const {
  const int64_t joints = skeleton_.joints();
  const Tensor position = features.narrow(-1, 0, 3);
  const Tensor rotation = ExpMapBatch(
      features.narrow(-1, 3, 3 * joints).reshape({features.size(0), features.size(1), joints, 3}));
  if (!context.reference.position.defined()) return {position, rotation};
  return {context.reference.position + position,
          torch::matmul(context.reference.rotation, rotation)};
}

Tensor FlowModelImpl::Rollout(const Tensor& history, const Tensor& audio, const Tensor& has_audio,
                              const TransitionContext& context, const Tensor& noise) {
  const int64_t tau = config_.history_frames, frames = noise.size(1);
  const std::vector<Tensor> inverse_weights = InverseWeights();
  FlowState state = flow_->InitialState(noise.size(0));
  std::vector<Tensor> past = history.unbind(1);
  Tensor follow = torch::ones({width_}, noise.options());
  follow.narrow(0, 0, 3 + 3 * skeleton_.joints()).fill_(config_.follow);
  for (int64_t t = 0; t < frames; ++t) {
    const std::vector<Tensor> window(past.end() - tau, past.end());
    const Tensor proposed =
        Step(torch::stack(window, 1), audio.narrow(1, t, tau + 1), has_audio,
             context.static_condition.select(1, t), config_.fine_temperature * noise.select(1, t),
             inverse_weights, &state)
            .features;
    past.push_back(has_planner() ? past.back() + follow * (proposed - past.back()) : proposed);
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
