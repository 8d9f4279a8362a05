#pragma once

#include <string>

/// Process-wide arithmetic settings: BLAS, threads, denormals. Call from main before other threads
/// start.
namespace choreo {

/// The BLAS that this process runs, as the dynamic linker reports it.
struct BlasInfo {
  enum class Kind {
    kNone,       ///< no BLAS is loaded: large products use no BLAS
    kReference,  ///< Netlib's reference: correct, but 10 to 50 times too slow to serve
    kFast,       ///< OpenBLAS, MKL or BLIS
    kUnknown,    ///< unrecognised
  };
  Kind kind = Kind::kNone;
  std::string name;  ///< the library's own description ("OpenBLAS 0.3.21 ..."), or the file's name
  std::string path;  ///< the library's file, links resolved; empty if there is none
};

BlasInfo DetectBlas();

/// Throws Error(kFailedPrecondition) that says what to install if `blas` is the reference BLAS.
/// Returns a warning if its speed is unknown, and "" if it is fast.
std::string RequireFastBlas(const BlasInfo& blas);

/// The number of cores that this process may use, given CPU affinity and cgroup quota; at least 1.
int UsableCores();

/// The CPU time that the calling thread has used, seconds.
double ThreadCpuSeconds();

inline constexpr int kMaxMathThreads = 1024;  ///< for one matrix product

/// Sets the threads per matrix product in every loaded BLAS and OpenMP runtime. Throws
/// Error(kInvalidArgument) unless threads is in [1, kMaxMathThreads]. For LibTorch's pools see
/// model/samplers/samplers.h.
void SetMathThreads(int threads);

/// Flushes denormals to zero on the calling thread and on threads that it starts later. An
/// operation on denormals is 100 times slower, and recurrent states decay into them. No effect
/// except on x86-64 and AArch64.
void FlushDenormals();

}  // namespace choreo
