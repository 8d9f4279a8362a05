#pragma once

/// Compiles a function for each kind of CPU; the program takes the fastest. Bits are the same,
/// because no kind has fused multiply-add, which rounds differently.
#if defined(__x86_64__)
#define CHOREO_EACH_CPU [[gnu::target_clones("avx2", "default")]]
#else
#define CHOREO_EACH_CPU
#endif
