#pragma once

#include <span>

/// The packed engine's inner loops, compiled once per instruction set. Every element of a product
/// is one sum over the depth from first to last, so a row's bits depend neither on its place nor on
/// how many rows are multiplied with it.
///
/// All numbers are float32, except with PackedKernels::pair: elements of `a` and `b` are then pairs
/// of bfloat16, adjacent in depth, and the depth is halved. Sums stay float32.
namespace choreo {

/// c [rows, panels * panel] = init + a b. `b` is in panels of PackedKernels::panel columns, padded
/// with zeros, each [depth, panel], one after another.
struct PackedProduct {
  const float* a = nullptr;  ///< [rows, depth]
  long a_stride = 0;         ///< floats between rows
  const float* b = nullptr;
  long depth = 0, panels = 0;
  const float* init = nullptr;  ///< [rows, panels * panel]; may be `c`
  long init_stride = 0;         ///< 0: one row for all (a bias)
  float* c = nullptr;
  long c_stride = 0;
  long rows = 0;
};

/// The inverse of the affine coupling (paper F, Eq. 7) on one row.
struct PackedCoupling {
  const float* ab = nullptr;  ///< [a, b], 2 * width
  float* high = nullptr;      ///< width, z_hi -> h_hi
  long width = 0;
  float delta_bias = 0, delta_floor = 0;
};

struct PackedKernels {
  const char* name;  ///< "avx512"
  long panel;        ///< columns
  /// out [count / 2, rounded up] = x in pairs of bfloat16, an odd one padded with zero. Null:
  /// products take floats directly.
  void (*pair)(const float* x, long count, float* out);
  void (*multiply)(const PackedProduct& product);
  /// x = silu(x)
  void (*silu)(float* x, long count);
  /// One LSTM cell of a row: gates [4 * width] (input, forget, cell, output), state updated.
  void (*lstm)(const float* gates, float* hidden, float* cell, long width);
  /// Returns the product of the deltas; its logarithm is the log-determinant.
  double (*coupling)(const PackedCoupling& coupling);
  /// out [repeats, width] = clamp((x - mean) * scale, -bound, bound), mean and scale [width]
  void (*standardise)(const float* x, const float* mean, const float* scale, long width,
                      long repeats, float bound, float* out);
  /// out = (x, softly limited to bound + 1 beyond `bound`) * scale + mean
  void (*bend)(const float* x, const float* mean, const float* scale, long width, float bound,
               float* out);
  /// Softmax of a row of logits, in place.
  void (*softmax)(float* x, long count);
  /// out = (x - its mean) / its standard deviation * gain + bias, all [width]
  void (*layer_norm)(const float* x, const float* gain, const float* bias, long width, float* out);
  /// x = x times the normal distribution function at x
  void (*gelu)(float* x, long count);
};

/// The float32 kernels that this machine can run, fastest first; never empty.
std::span<const PackedKernels* const> PackedKernelsHere();
/// The kernels with bfloat16 products that this machine can run. Their panel is the fastest float32
/// kernels'. Empty if the machine has no instructions for them.
std::span<const PackedKernels* const> Bf16KernelsHere();

}  // namespace choreo
