#include "model/papers/networks/coupling_flow.h"

#include <torch/nn/init.h>
#include <torch/utils.h>

namespace choreo {

using torch::Tensor;
using torch::indexing::Ellipsis;
using torch::indexing::Slice;

CouplingNetworkImpl::CouplingNetworkImpl(int input, int hidden, int output) : hidden_(hidden) {
  lstm_ = register_module(
      "lstm", torch::nn::LSTM(
                  torch::nn::LSTMOptions(input, hidden).num_layers(kLstmLayers).batch_first(true)));
  last_ = register_module("last", torch::nn::Linear(hidden, output));
  torch::nn::init::zeros_(last_->weight);
  torch::nn::init::zeros_(last_->bias);
}

Tensor CouplingNetworkImpl::RunFused(const Tensor& input, CouplingState* state) {
  const std::vector<Tensor> weights = lstm_->parameters();  // layer by layer
  Tensor x = input;
  for (size_t layer = 0; layer < kLstmLayers; ++layer) {
    const auto from = weights.begin() + static_cast<std::ptrdiff_t>(4 * layer);
    x = RunLstmLayer(x, {from[0], from[1], from[2], from[3]}, &(*state)[layer]);
  }
  return x;
}

Tensor CouplingNetworkImpl::forward(const Tensor& input, CouplingState* state) {
  const auto inside = last_->weight.scalar_type(), outside = input.scalar_type();
  // Without gradients, LibTorch's own layer runs, which is the reference.
  if (torch::GradMode::is_enabled() && input.is_cpu() && inside == torch::kFloat32 &&
      outside == torch::kFloat32)
    return last_(RunFused(input, state));
  const auto both = [&](Tensor LstmState::*part) {
    return torch::stack({(*state)[0].*part, (*state)[1].*part}).to(inside);
  };
  const auto [output, next] =
      lstm_->forward(input.to(inside), std::make_tuple(both(&LstmState::h), both(&LstmState::c)));
  const auto [h, c] = next;
  for (size_t layer = 0; layer < kLstmLayers; ++layer) {
    const auto at = static_cast<int64_t>(layer);
    (*state)[layer] = {h[at].to(outside), c[at].to(outside)};
  }
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
                                               CouplingState* state) {
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

Tensor FlowStepImpl::Forward(const Tensor& x, const Tensor& condition, CouplingState* state,
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
                             CouplingState* state, Tensor* log_det) {
  const Tensor low = z.index({Ellipsis, Slice(0, low_)});
  const auto [mu, delta] = Affine(low, condition, state);
  const Tensor high = (z.index({Ellipsis, Slice(low_)}) - mu) / delta;
  const Tensor normed = torch::matmul(torch::cat({low, high}, -1), inverse_weight);
  if (log_det != nullptr)
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

FlowState Joined(const std::vector<CouplingState>& states) {
  std::vector<Tensor> pieces;
  for (const CouplingState& state : states) {
    for (const LstmState& layer : state) pieces.push_back(layer.h);
    for (const LstmState& layer : state) pieces.push_back(layer.c);
  }
  return torch::cat(pieces, -1);
}

}  // namespace

std::vector<CouplingState> CouplingFlowImpl::Split(const FlowState& state) const {
  const auto count = static_cast<int64_t>(steps_->size());
  const std::vector<Tensor> pieces = state.chunk(2 * kLstmLayers * count, -1);
  std::vector<CouplingState> states(steps_->size());
  for (size_t k = 0; k < states.size(); ++k) {
    for (size_t layer = 0; layer < kLstmLayers; ++layer) {
      const size_t h = 2 * kLstmLayers * k + layer;
      states[k][layer] = {pieces[h], pieces[h + kLstmLayers]};
    }
  }
  return states;
}

Tensor CouplingFlowImpl::Forward(const Tensor& x, const Tensor& condition, FlowState* state,
                                 Tensor* log_det) {
  Tensor h = x;
  std::vector<CouplingState> states = Split(*state);
  for (size_t k = 0; k < states.size(); ++k)
    h = steps_->ptr(k)->as<FlowStep>()->Forward(h, condition, &states[k], log_det);
  *state = Joined(states);
  return h;
}

Tensor CouplingFlowImpl::Inverse(const Tensor& z, const Tensor& condition,
                                 const std::vector<Tensor>& inverse_weights,
                                 std::vector<CouplingState>* states, Tensor* log_det) {
  Tensor h = z;
  for (size_t k = states->size(); k-- > 0;)
    h = steps_->ptr(k)->as<FlowStep>()->Inverse(h, condition, inverse_weights[k], &(*states)[k],
                                                log_det);
  return h;
}

Tensor CouplingFlowImpl::Inverse(const Tensor& z, const Tensor& condition,
                                 const std::vector<Tensor>& inverse_weights, FlowState* state,
                                 Tensor* log_det) {
  std::vector<CouplingState> states = Split(*state);
  const Tensor x = Inverse(z, condition, inverse_weights, &states, log_det);
  *state = Joined(states);
  return x;
}

std::vector<Tensor> CouplingFlowImpl::InverseWeights() const {
  std::vector<Tensor> weights;
  for (const auto& step : *steps_) weights.push_back(step->as<FlowStep>()->InverseWeight());
  return weights;
}

void CouplingFlowImpl::InitialiseActNorm(const Tensor& x, const Tensor& condition) {
  torch::NoGradGuard no_grad;
  Tensor h = x;
  std::vector<CouplingState> states = Split(InitialState(x.size(0)));
  Tensor log_det = torch::zeros({x.size(0), x.size(1)}, x.options());
  for (size_t k = 0; k < states.size(); ++k) {
    const auto step = steps_->ptr(k)->as<FlowStep>();
    step->InitialiseActNorm(h);
    h = step->Forward(h, condition, &states[k], &log_det);
  }
}

}  // namespace choreo
