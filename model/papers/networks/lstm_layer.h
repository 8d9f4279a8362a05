#pragma once

#include <torch/types.h>

#include <array>

namespace choreo {

/// Hidden and cell state, [batch, hidden] each.
struct LstmState {
  torch::Tensor h, c;
};

/// Weights as LibTorch has them: input [4 hidden, in], hidden [4 hidden, hidden], their biases [4
/// hidden].
using LstmWeights = std::array<torch::Tensor, 4>;

/// One LSTM layer on the CPU, float32: `x` [batch, time, in] → [batch, time, hidden]; `state` is
/// read and replaced. What torch's own computes, but with one node of the graph for all of its
/// steps: on few cores training is bound by those.
torch::Tensor RunLstmLayer(const torch::Tensor& x, const LstmWeights& weights, LstmState* state);

}  // namespace choreo
