// Compiled once for each instruction set (CMakeLists.txt). Nothing of the standard library is
// called, because the linker could take such an inline function's copy from here for all machines.
//   CHOREO_KERNELS        variable to define
//   CHOREO_KERNELS_NAME   what it is called
//   CHOREO_VECTOR_BYTES   of one register
//   CHOREO_MAX_ROWS       of which two registers each are summed at once
//   CHOREO_BF16           1: products of pairs of bfloat16, AVX512-BF16's
//   CHOREO_TILES          1: the same, AMX's
#if CHOREO_BF16
#include <immintrin.h>
#endif

#include "model/engine/packed/kernels.h"

namespace choreo {
extern const PackedKernels CHOREO_KERNELS;
namespace {

constexpr int kVectorBytes = CHOREO_VECTOR_BYTES;
constexpr long kLanes = kVectorBytes / 4;
constexpr long kPanel = 2 * kLanes;

// Aligned like floats: rows begin anywhere.
typedef float Vector __attribute__((vector_size(kVectorBytes), aligned(4), may_alias));

#if CHOREO_BF16
// Rounds to the nearest bfloat16; ties to even.
inline unsigned Round(float x) {
  const unsigned bits = __builtin_bit_cast(unsigned, x);
  return (bits + 0x7FFFU + ((bits >> 16) & 1U)) >> 16;
}

void Pair(const float* __restrict x, long count, float* __restrict out) {
  for (long i = 0; i < count / 2; ++i) {
    out[i] = __builtin_bit_cast(float, Round(x[2 * i]) | Round(x[2 * i + 1]) << 16);
  }
  if (count % 2 == 1) out[count / 2] = __builtin_bit_cast(float, Round(x[count - 1]));
}
#else
constexpr void (*Pair)(const float*, long, float*) = nullptr;
#endif

#if CHOREO_TILES
#include "model/engine/packed/tiles_of_one_cpu.h"
#else
constexpr int kMaxRows = CHOREO_MAX_ROWS;
constexpr long kAhead = 512;  // floats to prefetch

#if CHOREO_BF16
// An element of a product is two numbers.
inline Vector MultiplyAdd(Vector sum, float x, Vector weight) {
  const __m512i pair = _mm512_set1_epi32(__builtin_bit_cast(int, x));
  return _mm512_dpbf16_ps(sum, __builtin_bit_cast(__m512bh, pair),
                          __builtin_bit_cast(__m512bh, weight));
}
#else
inline Vector MultiplyAdd(Vector sum, float x, Vector weight) { return sum + x * weight; }
#endif

template <int kRows, int kPanels>
void Block(const PackedProduct& p, long row, long panel) {
  constexpr int kVectors = 2 * kPanels;
  const float* a = p.a + row * p.a_stride;
  const float* init = p.init + row * p.init_stride + panel * kPanel;
  Vector sum[kRows][kVectors];
#pragma GCC unroll 16
  for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 8
    for (int v = 0; v < kVectors; ++v) {
      sum[r][v] = *reinterpret_cast<const Vector*>(init + r * p.init_stride + v * kLanes);
    }
  }
  const float* b = p.b + panel * p.depth * kPanel;
  for (long k = 0; k < p.depth; ++k, b += kPanel) {
    Vector weight[kVectors];
#pragma GCC unroll 8
    for (int v = 0; v < kVectors; ++v) {
      const float* at = b + v / 2 * p.depth * kPanel + v % 2 * kLanes;
      weight[v] = *reinterpret_cast<const Vector*>(at);
      __builtin_prefetch(at + kAhead);
    }
#pragma GCC unroll 16
    for (int r = 0; r < kRows; ++r) {
      const float x = a[r * p.a_stride + k];
#pragma GCC unroll 8
      for (int v = 0; v < kVectors; ++v) sum[r][v] = MultiplyAdd(sum[r][v], x, weight[v]);
    }
  }
  float* c = p.c + row * p.c_stride + panel * kPanel;
#pragma GCC unroll 16
  for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 8
    for (int v = 0; v < kVectors; ++v) {
      *reinterpret_cast<Vector*>(c + r * p.c_stride + v * kLanes) = sum[r][v];
    }
  }
}

template <int kRows>
void OnePanel(const PackedProduct& p, long row, long rows, long panel) {
  if constexpr (kRows > 1) {
    if (rows < kRows) return OnePanel<kRows - 1>(p, row, rows, panel);
  }
  Block<kRows, 1>(p, row, panel);
}

void Multiply(const PackedProduct& p) {
  // Few rows leave registers free for several panels, which keeps sums from waiting for each other.
  const long together = p.rows <= 2 ? 4 : p.rows <= 4 ? 2 : 1;
  const long blocks = (p.rows + kMaxRows - 1) / kMaxRows;
  for (long panel = 0; panel < p.panels;) {
    if (together == 4 && p.panels - panel >= 4) {
      p.rows == 1 ? Block<1, 4>(p, 0, panel) : Block<2, 4>(p, 0, panel);
      panel += 4;
    } else if (together >= 2 && p.panels - panel >= 2) {
      p.rows == 1   ? Block<1, 2>(p, 0, panel)
      : p.rows == 2 ? Block<2, 2>(p, 0, panel)
      : p.rows == 3 ? Block<3, 2>(p, 0, panel)
                    : Block<4, 2>(p, 0, panel);
      panel += 2;
    } else {
      // Shares are even: a last block of one row costs nearly as much as a full one.
      long row = 0;
      for (long left = blocks; left > 0; --left) {
        const long rows = (p.rows - row + left - 1) / left;
        OnePanel<kMaxRows>(p, row, rows, panel);
        row += rows;
      }
      ++panel;
    }
  }
}
#endif

#include "model/engine/packed/rows_of_one_cpu.h"

}  // namespace

const PackedKernels CHOREO_KERNELS = {.name = CHOREO_KERNELS_NAME,
                                      .panel = kPanel,
                                      .pair = Pair,
                                      .multiply = Multiply,
                                      .silu = Silu,
                                      .lstm = Lstm,
                                      .coupling = Coupling,
                                      .standardise = Standardise,
                                      .bend = Bend,
                                      .softmax = Softmax,
                                      .layer_norm = LayerNorm,
                                      .gelu = Gelu};

}  // namespace choreo
