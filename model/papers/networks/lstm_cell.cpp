#include "model/papers/networks/lstm_cell.h"

namespace choreo {

void DoubleCellGate(float* gates, size_t rows, size_t hidden) {
  for (size_t row = 0; row < rows; ++row) {
    float* __restrict g = gates + row * 4 * hidden + 2 * hidden;
    for (size_t i = 0; i < hidden; ++i) g[i] += g[i];
  }
}

void UpdateCell(const float* gates, const float* before, float* cell, size_t rows, size_t hidden) {
  for (size_t row = 0; row < rows; ++row) {
    const float* in = gates + row * 4 * hidden;
    const float *forget = in + hidden, *g = forget + hidden;
    const float* c = before + row * hidden;
    float* __restrict next = cell + row * hidden;
    for (size_t i = 0; i < hidden; ++i) next[i] = forget[i] * c[i] + in[i] * (2.0F * g[i] - 1.0F);
  }
}

void EmitHidden(const float* gates, const float* squashed, float* out, size_t rows, size_t hidden) {
  for (size_t row = 0; row < rows; ++row) {
    const float* o = gates + row * 4 * hidden + 3 * hidden;
    const float* c = squashed + row * hidden;
    float* __restrict h = out + row * hidden;
    for (size_t i = 0; i < hidden; ++i) h[i] = o[i] * c[i];
  }
}

void BackThroughCell(const float* gates, const float* before, const float* squashed,
                     const float* hidden_gradient, float* cell_gradient, float* gate_gradients,
                     size_t rows, size_t hidden) {
  for (size_t row = 0; row < rows; ++row) {
    const float* in = gates + row * 4 * hidden;
    const float *forget = in + hidden, *cell = forget + hidden, *out = cell + hidden;
    const float *c = before + row * hidden, *tc = squashed + row * hidden;
    const float* dh = hidden_gradient + row * hidden;
    float* __restrict dc = cell_gradient + row * hidden;
    float* __restrict d = gate_gradients + row * 4 * hidden;
    for (size_t i = 0; i < hidden; ++i) {
      const float o = out[i], f = forget[i], a = in[i], g = 2.0F * cell[i] - 1.0F;
      const float whole = dc[i] + dh[i] * o * (1.0F - tc[i] * tc[i]);
      d[i] = whole * g * a * (1.0F - a);
      d[hidden + i] = whole * c[i] * f * (1.0F - f);
      d[2 * hidden + i] = whole * a * (1.0F - g * g);
      d[3 * hidden + i] = dh[i] * tc[i] * o * (1.0F - o);
      dc[i] = whole * f;
    }
  }
}

}  // namespace choreo
