#pragma once

/// Compiles a function for several instruction sets and runs the fastest that the CPU has. Bits are
/// equal on all, because none of these sets has fused multiply-add, which rounds differently.
#if defined(__x86_64__)
#define CHOREO_EACH_CPU [[gnu::target_clones("avx2", "default")]]
#else
#define CHOREO_EACH_CPU
#endif
