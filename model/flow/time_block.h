#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>
#include <torch/nn/pimpl.h>
#include <torch/types.h>

namespace choreo {

/// Pre-norm transformer block over frames, with a learnt bias for every clipped distance in time.
class TimeBlockImpl : public torch::nn::Module {
 public:
  TimeBlockImpl(int width, int heads, double dropout);
  /// x [batch, time, width]; `distance` as TimeDistances has it.
  torch::Tensor forward(const torch::Tensor& x, const torch::Tensor& distance);

 private:
  double dropout_;
  torch::nn::LayerNorm attention_norm_{nullptr}, mlp_norm_{nullptr};
  torch::nn::Linear qkv_{nullptr}, out_{nullptr}, up_{nullptr}, down_{nullptr};
  torch::Tensor distance_bias_;  // [distances, heads]
};
TORCH_MODULE(TimeBlock);

/// Attention over time with a learnt bias for each distance. qkv [batch, time, 3 width]: queries,
/// keys, values; `bias` [distances, heads]; `distance` as TimeDistances has it → [batch, time,
/// width].
torch::Tensor AttendInTime(const torch::Tensor& qkv, const torch::Tensor& bias,
                           const torch::Tensor& distance);

/// Places farther apart than this count as so far.
inline constexpr int64_t kMaxDistance = 96;
/// [time, time] indices into bias tables of 2 `most` + 1 distances.
torch::Tensor TimeDistances(int64_t time, torch::Device device, int64_t most = kMaxDistance);

/// Low-pass of x [..., time, features] over time: a Gaussian of `sigma` frames, its weights' sum
/// one near both ends too.
torch::Tensor SmoothInTime(const torch::Tensor& x, double sigma);

}  // namespace choreo
