#pragma once

#include <torch/types.h>

#include <array>

namespace choreo {

/// Hidden and cell state, [batch, hidden] each.
struct LstmState {
  torch::Tensor h, c;
};

/// Weights in LibTorch's layout: input [4 hidden, in], hidden [4 hidden, hidden], their biases [4
/// hidden].
using LstmWeights = std::array<torch::Tensor, 4>;

/// One LSTM layer on the CPU, float32: `x` [batch, time, in] → [batch, time, hidden]; `state` is
/// read and replaced. Computes the same as torch's layer with one graph node for all steps, because
/// on few cores the number of nodes limits training.
torch::Tensor RunLstmLayer(const torch::Tensor& x, const LstmWeights& weights, LstmState* state);

}  // namespace choreo
