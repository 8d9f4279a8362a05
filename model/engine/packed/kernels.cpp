#include "model/engine/packed/kernels.h"

#include <vector>

namespace choreo {

extern const PackedKernels kAnyKernels;
#if defined(__x86_64__)
extern const PackedKernels kAvx512Bf16Kernels;
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

const PackedKernels* Bf16KernelsHere() {
#if defined(__x86_64__)
  if (PackedKernelsHere().front() == &kAvx512Kernels && __builtin_cpu_supports("avx512bf16"))
    return &kAvx512Bf16Kernels;
#endif
  return nullptr;
}

}  // namespace choreo
