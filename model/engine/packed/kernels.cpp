#include "model/engine/packed/kernels.h"

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

// Linux lends a process the registers of AMX's tiles when it asks for them.
bool HasTiles() {
  constexpr int kRequestPermission = 0x1023, kTileData = 18;  // <asm/prctl.h>, XFEATURE_XTILEDATA
  return __builtin_cpu_supports("amx-tile") && __builtin_cpu_supports("amx-bf16") &&
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
