#include "model/flow/time_block.h"

#include <torch/torch.h>

#include <cmath>

namespace choreo {

using torch::Tensor;

TimeBlockImpl::TimeBlockImpl(int width, int heads, double dropout) : dropout_(dropout) {
  using torch::nn::LayerNormOptions;
  attention_norm_ =
      register_module("attention_norm", torch::nn::LayerNorm(LayerNormOptions({width})));
  mlp_norm_ = register_module("mlp_norm", torch::nn::LayerNorm(LayerNormOptions({width})));
  qkv_ = register_module("qkv", torch::nn::Linear(width, 3 * width));
  out_ = register_module("out", torch::nn::Linear(width, width));
  up_ = register_module("up", torch::nn::Linear(width, 2 * width));
  down_ = register_module("down", torch::nn::Linear(2 * width, width));
  distance_bias_ = register_parameter("distance_bias", torch::zeros({2 * kMaxDistance + 1, heads}));
}

Tensor TimeBlockImpl::forward(const Tensor& x, const Tensor& distance) {
  const Tensor mixed = AttendInTime(qkv_(attention_norm_(x)), distance_bias_, distance);
  const auto drop = [this](const Tensor& y) { return torch::dropout(y, dropout_, is_training()); };
  const Tensor attended = x + drop(out_(mixed));
  return attended + drop(down_(torch::gelu(up_(mlp_norm_(attended)))));
}

Tensor AttendInTime(const Tensor& qkv, const Tensor& bias, const Tensor& distance) {
  const int64_t batch = qkv.size(0), time = qkv.size(1), width = qkv.size(2) / 3;
  const int64_t heads = bias.size(1);
  // [3, batch, heads, time, head width]
  const Tensor parts = qkv.view({batch, time, 3, heads, width / heads}).permute({2, 0, 3, 1, 4});
  const Tensor added =
      bias.index_select(0, distance.flatten()).view({time, time, heads}).permute({2, 0, 1});
  const double scale = 1 / std::sqrt(static_cast<double>(width / heads));
  const Tensor attention =
      torch::softmax(torch::matmul(parts[0] * scale, parts[1].transpose(-1, -2)) + added, -1);
  return torch::matmul(attention, parts[2]).transpose(1, 2).reshape({batch, time, width});
}

Tensor TimeDistances(int64_t time, torch::Device device, int64_t most) {
  const Tensor steps =
      torch::arange(time, torch::TensorOptions().dtype(torch::kLong).device(device));
  return (steps.unsqueeze(0) - steps.unsqueeze(1)).clamp(-most, most) + most;
}

Tensor SmoothInTime(const Tensor& x, double sigma) {
  const Tensor at = torch::arange(x.size(-2), x.options());
  const Tensor apart = (at.unsqueeze(0) - at.unsqueeze(1)) / sigma;
  return torch::matmul(torch::softmax(-0.5 * apart.square(), 1), x);
}

}  // namespace choreo
