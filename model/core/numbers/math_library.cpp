#include "model/core/numbers/math_library.h"

#include <features.h>
#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

namespace choreo {

std::string MathLibrary() {
#if defined(__GLIBC__)
  std::string name = std::string("glibc ") + gnu_get_libc_version();
#else
  std::string name = "an unknown C library";
#endif
#if defined(__x86_64__)
  // The choice that glibc makes (sysdeps/x86_64/fpu/multiarch/ifunc-avx-fma4.h).
  const bool avx2 = __builtin_cpu_supports("avx2"), fma = __builtin_cpu_supports("fma");
  if (avx2 && fma) {
    name += " fma";
  } else if (__builtin_cpu_supports("fma4")) {
    name += " fma4";
  } else if (__builtin_cpu_supports("avx")) {
    name += " avx";
  }
#endif
  return name;
}

}  // namespace choreo
