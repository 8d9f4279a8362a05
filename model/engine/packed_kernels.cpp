#include "model/engine/packed_kernels.h"

#include <algorithm>
#include <vector>

#include "model/core/random.h"

namespace choreo {

extern const PackedKernels kAnyKernels;
#if defined(__x86_64__)
extern const PackedKernels kAvx512Kernels;
extern const PackedKernels kAvx2Kernels;
#endif

std::span<const PackedKernels* const> PackedKernelsHere() {
  static const std::vector<const PackedKernels*> here = [] {
    std::vector<const PackedKernels*> kernels;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq")) {
      kernels.push_back(&kAvx512Kernels);
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
      kernels.push_back(&kAvx2Kernels);
    }
#endif
    kernels.push_back(&kAnyKernels);
    return kernels;
  }();
  return here;
}

bool RowsAreIndependent(const PackedKernels& kernels) {
  constexpr long kRows = 40, kDepth = 67, kPanels = 7;
  const long columns = kPanels * kernels.panel;
  std::vector<float> a(kRows * kDepth), b(static_cast<size_t>(kDepth * columns)),
      bias(static_cast<size_t>(columns)), alone(static_cast<size_t>(kRows * columns)),
      together(alone.size());
  Random random(1);
  for (auto* values : {&a, &b, &bias}) random.FillNormal(*values);
  const auto multiply = [&](long first, long rows, std::vector<float>* c) {
    kernels.multiply({.a = a.data() + first * kDepth,
                      .a_stride = kDepth,
                      .b = b.data(),
                      .depth = kDepth,
                      .panels = kPanels,
                      .init = bias.data(),
                      .init_stride = 0,
                      .c = c->data() + first * columns,
                      .c_stride = columns,
                      .rows = rows});
  };
  for (long row = 0; row < kRows; ++row) multiply(row, 1, &alone);
  for (long rows = 2; rows <= kRows; ++rows) {
    for (const long first : {0L, kRows - rows}) {
      std::ranges::fill(together, 0.0F);
      multiply(first, rows, &together);
      if (!std::equal(alone.begin() + first * columns, alone.begin() + (first + rows) * columns,
                      together.begin() + first * columns)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace choreo
