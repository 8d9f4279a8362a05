#include "model/papers/networks/inbetweener.h"

#include <torch/nn/init.h>
#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/linear.h>
#include <torch/utils.h>

#include <algorithm>
#include <vector>

#include "model/motion/pose/pose_codec.h"
#include "model/papers/networks/key_condition.h"

namespace choreo {

using torch::Tensor;

namespace {

// Raised when the meaning of a stored tensor or field changes.
constexpr const char* kInbetweenerFormat = "choreo-inbetweener-1";

constexpr double kVeil = 0.5;                       // standard deviation, Section 3.4
constexpr double kNoVeilBelow = 5, kFullVeil = 30;  // frames left
constexpr double kStepScale = 0.125;  // deviations by which an output of 1 changes a feature
constexpr int64_t kFootContacts = 4;

// lambda_target of Section 3.4.
double VeilAt(int64_t frames_left) {
  const double way = (static_cast<double>(frames_left) - kNoVeilBelow) / (kFullVeil - kNoVeilBelow);
  return kVeil * std::clamp(way, 0.0, 1.0);
}

torch::nn::Sequential Encoder(int64_t in, int64_t hidden, int64_t out) {
  return torch::nn::Sequential(torch::nn::Linear(in, hidden), torch::nn::SiLU(),
                               torch::nn::Linear(hidden, out), torch::nn::SiLU());
}

}  // namespace

InbetweenerImpl::InbetweenerImpl(const FlowConfig& config, const Skeleton& skeleton)
    : config_(config),
      skeleton_(skeleton),
      width_(PoseCodec(skeleton).width()),
      pose_(PoseCodec(skeleton).velocity_at()) {
  mean_ = register_buffer("mean", torch::zeros({width_}));
  std_ = register_buffer("std", torch::ones({width_}));
  // Encodings are as wide as the embedding of the frames left.
  const int64_t hidden = config.hidden;
  const auto encoder = [&](const char* name, int64_t in) {
    return register_module(name, Encoder(in, hidden, width_));
  };
  state_encoder_ = encoder("state_encoder", 2 * pose_ + kFootContacts);
  offset_encoder_ = encoder("offset_encoder", pose_);
  target_encoder_ = encoder("target_encoder", pose_ + skeleton.joints() + 1);
  lstm_ = register_module(
      "lstm", torch::nn::LSTM(torch::nn::LSTMOptions(3 * width_, hidden).batch_first(true)));
  torch::nn::Linear last(hidden / 2, pose_ + kFootContacts);
  torch::nn::init::zeros_(last->weight);
  torch::nn::init::zeros_(last->bias);
  decoder_ = register_module("decoder", Encoder(hidden, hidden, hidden / 2));
  decoder_->push_back(last);
}

LstmState InbetweenerImpl::InitialState(int64_t batch) const {
  const Tensor zeros = torch::zeros({batch, config_.hidden}, mean_.options());
  return {zeros, zeros};
}

Tensor InbetweenerImpl::Remember(const Tensor& inputs, LstmState* state) {
  if (torch::GradMode::is_enabled()) {
    const std::vector<Tensor> weights = lstm_->parameters();
    return RunLstmLayer(inputs, {weights[0], weights[1], weights[2], weights[3]}, state);
  }
  const auto [out, next] =
      lstm_->forward(inputs, std::make_tuple(state->h.unsqueeze(0), state->c.unsqueeze(0)));
  *state = {std::get<0>(next).squeeze(0), std::get<1>(next).squeeze(0)};
  return out;
}

Tensor InbetweenerImpl::Step(const Tensor& past, const Tensor& condition, const Tensor& veil,
                             LstmState* state) {
  const int64_t joints = skeleton_.joints(), known = past.size(1) - 1;
  const Tensor standard =
      ((past - mean_) / std_).clamp(-kFeatureClamp, kFeatureClamp).narrow(2, 0, pose_);
  const Tensor poses = standard.narrow(1, 1, known);
  const Tensor steps = (poses - standard.narrow(1, 0, known)) / kStepScale;
  const Tensor contacts = past.narrow(1, 1, known).narrow(2, width_ - kFootContacts, kFootContacts);

  // Masks degrees of freedom that the key leaves open, in the key and in the difference to it.
  const Tensor key_mask = condition.narrow(1, pose_, joints + 1);
  const Tensor mask = torch::cat({key_mask.narrow(1, joints, 1), key_mask.narrow(1, 0, joints)}, 1)
                          .repeat_interleave(3, 1);
  const Tensor goal =
      mask * (condition.narrow(1, 0, pose_) - mean_.narrow(0, 0, pose_)) / std_.narrow(0, 0, pose_);
  const Tensor left = condition.narrow(1, pose_ + joints + 1, width_).unsqueeze(1);
  const Tensor offset = goal.unsqueeze(1) - poses * mask.unsqueeze(1);
  const Tensor target = target_encoder_->forward(torch::cat({goal, key_mask}, 1)).unsqueeze(1);
  Tensor key = torch::cat({offset_encoder_->forward(offset) + left,
                           (target + left).expand({target.size(0), known, width_})},
                          2);
  if (veil.defined()) key = key + veil.unsqueeze(1);
  const Tensor body = state_encoder_->forward(torch::cat({poses, steps, contacts}, 2)) + left;
  const Tensor hidden = Remember(torch::cat({body, key}, 2), state).select(1, known - 1);

  const Tensor drawn = decoder_->forward(hidden);
  const Tensor step = kStepScale * std_.narrow(0, 0, pose_) * drawn.narrow(1, 0, pose_);
  return torch::cat({past.select(1, known).narrow(1, 0, pose_) + step,
                     torch::zeros({past.size(0), width_ - pose_ - kFootContacts}, past.options()),
                     torch::sigmoid(drawn.narrow(1, pose_, kFootContacts))},
                    1);
}

Tensor InbetweenerImpl::Rollout(const Tensor& history, const Tensor& conditions) {
  const int64_t frames = conditions.size(1);
  Tensor noise;
  if (is_training()) noise = torch::randn({history.size(0), 2 * width_}, history.options());
  LstmState state = InitialState(history.size(0));
  Tensor past = history;
  std::vector<Tensor> made;
  for (int64_t t = 0; t < frames; ++t) {
    const Tensor veil = noise.defined() ? VeilAt(frames - t) * noise : Tensor();
    made.push_back(Step(past, conditions.select(1, t), veil, &state));
    past = torch::stack({past.select(1, past.size(1) - 1), made.back()}, 1);
  }
  return torch::stack(made, 1);
}

void InbetweenerImpl::SetNormalisation(const Tensor& mean, const Tensor& std) {
  torch::NoGradGuard no_grad;
  mean_.copy_(mean);
  std_.copy_(std);
}

bool HoldsInbetweener(const Safetensors& content) {
  const auto format = content.metadata.find("format");
  return format != content.metadata.end() && format->second.starts_with("choreo-inbetweener-");
}

InbetweenerCheckpoint ParseInbetweener(const Safetensors& content, const std::string& name) {
  return BuildCheckpoint<Inbetweener, FlowConfig>(CheckpointFile(content, name, kInbetweenerFormat),
                                                  content);
}

std::string SaveInbetweener(const std::filesystem::path& path, Inbetweener& model,
                            const nlohmann::json& card) {
  Safetensors content;
  ExportTensors(*model, "", &content);
  return WriteCheckpointFile(path, std::move(content), kInbetweenerFormat, model->config(),
                             model->skeleton(), card);
}

}  // namespace choreo
