#pragma once

#include <string>

/// Process-wide set-up of arithmetic: which BLAS is loaded, how many threads it uses, and how
/// denormal numbers are treated. Call from main, before other threads start.
namespace choreo {

/// The BLAS that this process runs, found by asking the dynamic linker.
struct BlasInfo {
  enum class Kind {
    kNone,       ///< no BLAS is loaded: nothing here multiplies large matrices
    kReference,  ///< Netlib's: correct, and 10 to 50 times too slow to serve
    kFast,       ///< OpenBLAS, MKL or BLIS
    kUnknown,    ///< a BLAS that names itself in no known way
  };
  Kind kind = Kind::kNone;
  std::string name;  ///< "OpenBLAS 0.3.21 ...", as it describes itself; else the file's name
  std::string path;  ///< the library's file, links resolved; empty if none or linked in
};

BlasInfo DetectBlas();

/// Throws Error(kFailedPrecondition) that tells what to install, if `blas` is the reference BLAS.
/// Returns a warning where nobody knows whether it is fast; empty for a fast one.
std::string RequireFastBlas(const BlasInfo& blas);

/// Cores that this process may use: its CPU affinity and its cgroup's quota taken together; >= 1.
int UsableCores();

inline constexpr int kMaxMathThreads = 1024;  ///< of one matrix product

/// Sets how many threads one matrix product uses, in every BLAS and OpenMP runtime loaded. Throws
/// Error(kInvalidArgument) unless threads is in [1, kMaxMathThreads]. LibTorch's own pools are the
/// business of model/samplers/samplers.h.
void SetMathThreads(int threads);

/// From here on, denormal results and operands count as zero on the calling thread and on threads
/// that it starts. Denormals cost 100 times a normal operation, and recurrent states decay into
/// them. Does nothing on machines other than x86-64 and AArch64.
void FlushDenormals();

}  // namespace choreo
