#include "model/engine/packed/kernels.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif
#include <sys/syscall.h>
#include <unistd.h>

#include <vector>

namespace choreo {

extern const PackedKernels kAnyKernels;
#if defined(__x86_64__)
extern const PackedKernels kAmxBf16Kernels;
extern const PackedKernels kAvx512Bf16Kernels;
extern const PackedKernels kAvx512Kernels;
extern const PackedKernels kAvx2Kernels;

namespace {

// Linux permits a process to use the registers of AMX's tiles on request.
bool HasTiles() {
  constexpr int kRequestPermission = 0x1023, kTileData = 18;  // <asm/prctl.h>, XFEATURE_XTILEDATA
  constexpr unsigned kTiles = 1U << 24U | 1U << 22U;          // AMX-TILE, AMX-BF16
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (d & kTiles) == kTiles &&
         syscall(SYS_arch_prctl, kRequestPermission, kTileData) == 0;
}

}  // namespace
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

std::span<const PackedKernels* const> Bf16KernelsHere() {
  static const std::vector<const PackedKernels*> here = [] {
    std::vector<const PackedKernels*> kernels;
#if defined(__x86_64__)
    if (PackedKernelsHere().front() == &kAvx512Kernels && __builtin_cpu_supports("avx512bf16")) {
      if (HasTiles()) kernels.push_back(&kAmxBf16Kernels);
      kernels.push_back(&kAvx512Bf16Kernels);
    }
#endif
    return kernels;
  }();
  return here;
}

}  // namespace choreo
