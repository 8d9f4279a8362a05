#include "model/flow/coupling_flow.h"

#include <torch/torch.h>

namespace choreo {

using torch::Tensor;
using torch::indexing::Ellipsis;
using torch::indexing::Slice;

CouplingNetworkImpl::CouplingNetworkImpl(int input, int hidden, int output) : hidden_(hidden) {
  lstm_ = register_module(
      "lstm",
      torch::nn::LSTM(torch::nn::LSTMOptions(input, hidden).num_layers(kLayers).batch_first(true)));
  last_ = register_module("last", torch::nn::Linear(hidden, output));
  torch::nn::init::zeros_(last_->weight);
  torch::nn::init::zeros_(last_->bias);
}

Tensor CouplingNetworkImpl::forward(const Tensor& input, Tensor* state) {
  const auto inside = last_->weight.scalar_type(), outside = input.scalar_type();
  const Tensor x = input.to(inside);
  // [batch, 2 * layers * hidden] ↔ h, c of [layers, batch, hidden]
  const int64_t batch = input.size(0);
  const Tensor split = state->view({batch, 2, kLayers, hidden_}).permute({1, 2, 0, 3}).to(inside);
  const auto [output, next] =
      lstm_->forward(x, std::make_tuple(split[0].contiguous(), split[1].contiguous()));
  *state = torch::stack({std::get<0>(next), std::get<1>(next)})
               .permute({2, 0, 1, 3})
               .reshape({batch, StateWidth()})
               .to(outside);
  return last_(output).to(outside);
}

FlowStepImpl::FlowStepImpl(int width, int condition, int hidden) : low_(width / 2) {
  norm_bias_ = register_parameter("norm_bias", torch::zeros({width}));
  norm_log_scale_ = register_parameter("norm_log_scale", torch::zeros({width}));
  // A random rotation, in the PLU form whose log-determinant is a sum (Kingma & Dhariwal 2018).
  const Tensor rotation =
      std::get<0>(torch::linalg_qr(torch::randn({width, width}, torch::kFloat64)));
  const auto [p, l, u] = torch::linalg_lu(rotation);
  const Tensor diagonal = u.diagonal();
  permutation_ = register_buffer("permutation", p.to(torch::kFloat32));
  sign_ = register_buffer("sign", diagonal.sign().to(torch::kFloat32));
  lower_ = register_parameter("lower", l.tril(-1).to(torch::kFloat32));
  upper_ = register_parameter("upper", u.triu(1).to(torch::kFloat32));
  log_diagonal_ = register_parameter("log_diagonal", diagonal.abs().log().to(torch::kFloat32));
  const int high = width - low_;
  network_ = register_module("network", CouplingNetwork(low_ + condition, hidden, 2 * high));
}

Tensor FlowStepImpl::Weight() const {
  const Tensor identity = torch::eye(lower_.size(0), lower_.options());
  return torch::matmul(permutation_,
                       torch::matmul(lower_.tril(-1) + identity,
                                     upper_.triu(1) + (sign_ * log_diagonal_.exp()).diag()));
}

Tensor FlowStepImpl::InverseWeight() const {
  return torch::inverse(Weight().to(torch::kFloat64)).t().to(lower_.dtype()).contiguous();
}

std::pair<Tensor, Tensor> FlowStepImpl::Affine(const Tensor& low, const Tensor& condition,
                                               Tensor* state) {
  const Tensor both = network_(torch::cat({low, condition}, -1), state);
  const auto halves = both.chunk(2, -1);
  const Tensor delta = kDeltaFloor + (1 - kDeltaFloor) * torch::sigmoid(halves[1] + kDeltaBias);
  return {(1 - delta) * halves[0], delta};
}

void FlowStepImpl::InitialiseActNorm(const Tensor& x) {
  torch::NoGradGuard no_grad;
  const Tensor flat = x.reshape({-1, x.size(-1)});
  const Tensor scale = flat.std(0).clamp_min(1e-2);
  norm_log_scale_.copy_(-scale.log());
  norm_bias_.copy_(-flat.mean(0));
}

Tensor FlowStepImpl::Forward(const Tensor& x, const Tensor& condition, Tensor* state,
                             Tensor* log_det) {
  const Tensor normed = (x + norm_bias_) * norm_log_scale_.exp();
  const Tensor h = torch::matmul(normed, Weight().t());
  const Tensor low = h.index({Ellipsis, Slice(0, low_)});
  const auto [mu, delta] = Affine(low, condition, state);
  const Tensor high = mu + delta * h.index({Ellipsis, Slice(low_)});
  *log_det = *log_det + norm_log_scale_.sum() + log_diagonal_.sum() + delta.log().sum(-1);
  return torch::cat({low, high}, -1);
}

Tensor FlowStepImpl::Inverse(const Tensor& z, const Tensor& condition, const Tensor& inverse_weight,
                             Tensor* state, Tensor* log_det) {
  const Tensor low = z.index({Ellipsis, Slice(0, low_)});
  const auto [mu, delta] = Affine(low, condition, state);
  const Tensor high = (z.index({Ellipsis, Slice(low_)}) - mu) / delta;
  const Tensor normed = torch::matmul(torch::cat({low, high}, -1), inverse_weight);
  *log_det = *log_det + norm_log_scale_.sum() + log_diagonal_.sum() + delta.log().sum(-1);
  return normed * (-norm_log_scale_).exp() - norm_bias_;
}

CouplingFlowImpl::CouplingFlowImpl(int width, int condition, const FlowConfig& config) {
  steps_ = register_module("steps", torch::nn::ModuleList());
  for (int k = 0; k < config.flow_steps; ++k)
    steps_->push_back(FlowStep(width, condition, config.hidden));
}

int CouplingFlowImpl::StateWidth() const {
  int width = 0;
  for (const auto& step : *steps_) width += step->as<FlowStep>()->StateWidth();
  return width;
}

FlowState CouplingFlowImpl::InitialState(int64_t batch) const {
  return torch::zeros({batch, StateWidth()}, steps_->ptr(0)->parameters()[0].options());
}

namespace {

// Cuts the flattened state into one piece a step, runs `visit(k, step, piece)` over the steps and
// puts the pieces together again.
template <typename Visit>
void WithStates(const torch::nn::ModuleList& steps, FlowState* state, bool backwards, Visit visit) {
  const int count = static_cast<int>(steps->size());
  std::vector<Tensor> pieces = state->chunk(count, -1);
  for (int i = 0; i < count; ++i) {
    const int k = backwards ? count - 1 - i : i;
    visit(k, *steps->ptr(k)->as<FlowStep>(), &pieces[k]);
  }
  *state = torch::cat(pieces, -1);
}

}  // namespace

Tensor CouplingFlowImpl::Forward(const Tensor& x, const Tensor& condition, FlowState* state,
                                 Tensor* log_det) {
  Tensor h = x;
  WithStates(steps_, state, false, [&](int, FlowStepImpl& step, Tensor* piece) {
    h = step.Forward(h, condition, piece, log_det);
  });
  return h;
}

Tensor CouplingFlowImpl::Inverse(const Tensor& z, const Tensor& condition,
                                 const std::vector<Tensor>& inverse_weights, FlowState* state,
                                 Tensor* log_det) {
  Tensor h = z;
  WithStates(steps_, state, true, [&](int k, FlowStepImpl& step, Tensor* piece) {
    h = step.Inverse(h, condition, inverse_weights[k], piece, log_det);
  });
  return h;
}

std::vector<Tensor> CouplingFlowImpl::InverseWeights() const {
  std::vector<Tensor> weights;
  for (const auto& step : *steps_) weights.push_back(step->as<FlowStep>()->InverseWeight());
  return weights;
}

void CouplingFlowImpl::InitialiseActNorm(const Tensor& x, const Tensor& condition) {
  torch::NoGradGuard no_grad;
  Tensor h = x;
  FlowState state = InitialState(x.size(0));
  Tensor log_det = torch::zeros({x.size(0), x.size(1)}, x.options());
  WithStates(steps_, &state, false, [&](int, FlowStepImpl& step, Tensor* piece) {
    step.InitialiseActNorm(h);
    h = step.Forward(h, condition, piece, &log_det);
  });
}

}  // namespace choreo
