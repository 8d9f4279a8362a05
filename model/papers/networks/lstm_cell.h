#pragma once

#include <cstddef>

/// The elementwise half of an LSTM layer, without torch, so that it compiles to fast code. Rows
/// have `hidden` numbers; rows of gates have 4 * hidden, in LibTorch's order: input, forget, cell,
/// output.
namespace choreo {

/// Doubles the cell gate's part of each row. As tanh(x) = 2 sigmoid(2 x) - 1, one sigmoid then
/// serves all four gates.
void DoubleCellGate(float* gates, size_t rows, size_t hidden);

/// Computes c = f c' + i g. `gates`: after the sigmoid. The three arrays must not overlap.
void UpdateCell(const float* gates, const float* before, float* cell, size_t rows, size_t hidden);

/// Computes h = o tanh(c). `squashed` is tanh(c).
void EmitHidden(const float* gates, const float* squashed, float* out, size_t rows, size_t hidden);

/// Backpropagates one step. `hidden_gradient`: of h. `cell_gradient`: of c, from later steps;
/// replaced by the gradient of c'. Writes `gate_gradients`, the gradients of the gates before
/// DoubleCellGate.
void BackThroughCell(const float* gates, const float* before, const float* squashed,
                     const float* hidden_gradient, float* cell_gradient, float* gate_gradients,
                     size_t rows, size_t hidden);

}  // namespace choreo
