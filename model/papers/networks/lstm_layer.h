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

/// Runs one LSTM layer on the CPU in float32: `x` [batch, time, in] → [batch, time, hidden]. Reads
/// and replaces `state`. Equals torch's layer, but has one graph node for all steps, because the
/// number of nodes limits training on few cores.
torch::Tensor RunLstmLayer(const torch::Tensor& x, const LstmWeights& weights, LstmState* state);

}  // namespace choreo
