#include "model/papers/networks/window_controller.h"

#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>

#include <cmath>

#include "model/papers/networks/transition_tensors.h"

namespace choreo {
namespace {

using torch::Tensor;

constexpr double kMaxScore = 40;

// Multi-head attention of short windows. [M, window, width] each.
class AttentionImpl : public torch::nn::Module {
 public:
  AttentionImpl(int width, int heads) : heads_(heads) {
    query_ = register_module("query", torch::nn::Linear(width, width));
    key_value_ = register_module("key_value", torch::nn::Linear(width, 2 * width));
    out_ = register_module("out", torch::nn::Linear(width, width));
  }
  Tensor forward(const Tensor& x, const Tensor& memory) {
    const int64_t rows = x.size(0), window = x.size(1), width = x.size(2), deep = width / heads_;
    const Tensor query = query_(x).view({rows, window, heads_, deep}).transpose(1, 2);
    const Tensor key_value =
        key_value_(memory).view({rows, memory.size(1), 2, heads_, deep}).permute({2, 0, 3, 1, 4});
    const Tensor score =
        torch::matmul(query, key_value[0].transpose(-1, -2)) / std::sqrt(static_cast<double>(deep));
    // A softmax of our own, because LibTorch's does not vectorise rows as short as a window.
    // Normalised inputs keep scores small; the bound is for safety.
    const Tensor power = score.clamp(-kMaxScore, kMaxScore).exp();
    const Tensor mixed = torch::matmul(power / power.sum(-1, true), key_value[1]);
    return out_(mixed.transpose(1, 2).reshape({rows, window, width}));
  }

 private:
  int heads_;
  torch::nn::Linear query_{nullptr}, key_value_{nullptr}, out_{nullptr};
};
TORCH_MODULE(Attention);

// "The residual add and layer norm are implemented after both": post-norm, as in the first
// transformers.
class LayerImpl : public torch::nn::Module {
 public:
  LayerImpl(const ControllersConfig& config, bool crosses) {
    const int width = config.width;
    const auto norm = [&](const char* name) {
      return register_module(name, torch::nn::LayerNorm(torch::nn::LayerNormOptions({width})));
    };
    self_ = register_module("self", Attention(width, config.heads));
    self_norm_ = norm("self_norm");
    if (crosses) {
      cross_ = register_module("cross", Attention(width, config.heads));
      cross_norm_ = norm("cross_norm");
    }
    up_ = register_module("up", torch::nn::Linear(width, config.feed_forward));
    down_ = register_module("down", torch::nn::Linear(config.feed_forward, width));
    norm_ = norm("norm");
  }
  Tensor forward(Tensor x, const Tensor& memory) {
    x = self_norm_(x + self_(x, x));
    if (!cross_.is_empty()) x = cross_norm_(x + cross_(x, memory));
    return norm_(x + down_(torch::relu(up_(x))));
  }

 private:
  Attention self_{nullptr}, cross_{nullptr};
  torch::nn::LayerNorm self_norm_{nullptr}, cross_norm_{nullptr}, norm_{nullptr};
  torch::nn::Linear up_{nullptr}, down_{nullptr};
};
TORCH_MODULE(Layer);

class TransformerController : public WindowControllerImpl {
 public:
  TransformerController(int features, const ControllersConfig& config) {
    embed_given_ = register_module("embed_given", torch::nn::Linear(features, config.width));
    embed_mixture_ = register_module("embed_mixture", torch::nn::Linear(features, config.width));
    encoders_ = register_module("encoders", torch::nn::ModuleList());
    decoders_ = register_module("decoders", torch::nn::ModuleList());
    for (int i = 0; i < config.layers; ++i) {
      encoders_->push_back(Layer(config, false));
      decoders_->push_back(Layer(config, true));
    }
    out_ =
        register_module("out", torch::nn::Linear(config.window * config.width, config.controller));
  }
  Tensor Encode(const Tensor& given) override {
    Tensor x = embed_given_(given) + Code(given);
    for (const auto& layer : *encoders_) x = layer->as<Layer>()->forward(x, {});
    return x;
  }
  Tensor Decode(const Tensor& memory, const Tensor& mixture) override {
    // The skip connection of Figure 3: the encoder's output bypasses the attention.
    Tensor x = embed_mixture_(mixture) + Code(mixture) + memory;
    for (const auto& layer : *decoders_) x = layer->as<Layer>()->forward(x, memory);
    return out_(x.flatten(1));
  }

 private:
  Tensor Code(const Tensor& window) const {
    return TimeEmbedding(torch::arange(window.size(1), window.options()),
                         embed_given_->weight.size(0));
  }

  torch::nn::Linear embed_given_{nullptr}, embed_mixture_{nullptr}, out_{nullptr};
  torch::nn::ModuleList encoders_, decoders_;
};

class ConnectedController : public WindowControllerImpl {
 public:
  ConnectedController(int features, const ControllersConfig& config) {
    first_ = register_module(
        "first", torch::nn::Linear(2 * config.window * features, config.encoder_hidden));
    activation_ = register_module("activation", torch::nn::PReLU());
    second_ =
        register_module("second", torch::nn::Linear(config.encoder_hidden, config.controller));
  }
  Tensor Encode(const Tensor& given) override { return given; }
  Tensor Decode(const Tensor& memory, const Tensor& mixture) override {
    return second_(activation_(first_(torch::cat({memory, mixture}, -1).flatten(1))));
  }

 private:
  torch::nn::Linear first_{nullptr}, second_{nullptr};
  torch::nn::PReLU activation_{nullptr};
};

}  // namespace

WindowController MakeWindowController(int features, const ControllersConfig& config) {
  if (config.transformers) return std::make_shared<TransformerController>(features, config);
  return std::make_shared<ConnectedController>(features, config);
}

}  // namespace choreo
