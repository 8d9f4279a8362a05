#pragma once

#include <cstddef>

/// The elementwise half of an LSTM layer, without torch so that it compiles to fast code. Rows of
/// `hidden` numbers; gates are rows of 4 * hidden, in LibTorch's order: input, forget, cell,
/// output.
namespace choreo {

/// Doubles the cell gate's part of each row: tanh(x) is 2 sigmoid(2 x) - 1, so that one sigmoid
/// serves all four.
void DoubleCellGate(float* gates, size_t rows, size_t hidden);

/// c = f c' + i g. `gates`: after the sigmoid. The three may not overlap.
void UpdateCell(const float* gates, const float* before, float* cell, size_t rows, size_t hidden);

/// h = o tanh(c). `squashed` is tanh(c).
void EmitHidden(const float* gates, const float* squashed, float* out, size_t rows, size_t hidden);

/// Backpropagates one step. `hidden_gradient` is that of h. `cell_gradient` is that of c from later
/// steps, and is replaced by that of c'. Writes `gate_gradients`, those of the gates before
/// DoubleCellGate.
void BackThroughCell(const float* gates, const float* before, const float* squashed,
                     const float* hidden_gradient, float* cell_gradient, float* gate_gradients,
                     size_t rows, size_t hidden);

}  // namespace choreo
