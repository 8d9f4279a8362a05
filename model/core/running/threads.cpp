#include "model/core/running/threads.h"

#include <dlfcn.h>
#include <sched.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

#if defined(__x86_64__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

#include "model/core/error.h"

namespace choreo {
namespace {

template <typename Function>
Function* Find(const char* symbol) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, symbol));
}

std::string FileOf(void* address) {
  Dl_info info;
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return "";
  std::error_code ignored;
  const auto path = std::filesystem::canonical(info.dli_fname, ignored);
  return path.empty() ? info.dli_fname : path.string();
}

// Parses cgroup v2's "quota period" in microseconds; "max" means no limit.
double CgroupCores() {
  std::ifstream file("/sys/fs/cgroup/cpu.max");
  double quota = 0;
  double period = 0;
  return file >> quota >> period && period > 0 ? quota / period : INFINITY;
}

}  // namespace

BlasInfo DetectBlas() {
  void* gemm = dlsym(RTLD_DEFAULT, "sgemm_");
  if (gemm == nullptr) gemm = dlsym(RTLD_DEFAULT, "cblas_sgemm");
  if (gemm == nullptr) return {};

  using enum BlasInfo::Kind;
  const std::string path = FileOf(gemm);
  const std::string file = std::filesystem::path(path).filename().string();
  // Debian's libblas.so.3 for OpenBLAS only forwards to libopenblas.so.0, so the library that
  // exports sgemm_ need not be the BLAS that runs. Where Netlib's library exports sgemm_ itself, it
  // runs, even if others are loaded.
  if (!path.ends_with("/blas/" + file)) {
    if (auto* config = Find<char*()>("openblas_get_config")) return {kFast, config(), path};
    if (Find<void>("MKL_Get_Version_String")) return {kFast, "Intel MKL", path};
    if (auto* version = Find<const char*()>("bli_info_get_version_str"))
      return {kFast, std::string("BLIS ") + version(), path};
  }
  if (file.starts_with("libblas.so")) return {kReference, "Netlib reference BLAS", path};
  return {kUnknown, file, path};
}

std::string RequireFastBlas(const BlasInfo& blas) {
  using enum BlasInfo::Kind;
  switch (blas.kind) {
    case kFast:
      return "";
    case kNone:
      return "no BLAS library is loaded; LibTorch brings its own, or products are slow";
    case kUnknown:
      return "the speed of the BLAS " + blas.name + " (" + blas.path +
             ") is unknown; OpenBLAS, MKL and BLIS are fast";
    case kReference:
      break;
  }
  throw Error(ErrorCode::kFailedPrecondition, "",
              "only the reference BLAS is installed (" + blas.path +
                  "), which is far too slow to dance in time; install a fast one: apt-get install "
                  "libopenblas0-pthread");
}

double ThreadCpuSeconds() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

int UsableCores() {
  double cores = std::max(1U, std::thread::hardware_concurrency());
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof(set), &set) == 0) cores = std::max(1, CPU_COUNT(&set));
  return std::max(1, static_cast<int>(std::floor(std::min(cores, CgroupCores()) + 0.5)));
}

void SetMathThreads(int threads) {
  if (threads < 1 || threads > kMaxMathThreads) {
    throw InvalidArgument("threads", std::to_string(threads) + " is not in [1, " +
                                         std::to_string(kMaxMathThreads) + "]");
  }
  for (const char* symbol :
       {"openblas_set_num_threads", "omp_set_num_threads", "MKL_Set_Num_Threads"}) {
    if (auto* set = Find<void(int)>(symbol); set != nullptr) set(threads);
  }
  if (auto* set = Find<void(int64_t)>("bli_thread_set_num_threads"); set != nullptr) set(threads);
}

void FlushDenormals() {
#if defined(__x86_64__)
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#elif defined(__aarch64__)
  uint64_t control;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  __asm__ volatile("msr fpcr, %0" : : "r"(control | (uint64_t{1} << 24)));
#endif
}

}  // namespace choreo
