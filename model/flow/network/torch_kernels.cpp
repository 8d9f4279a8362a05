#include "model/flow/network/torch_kernels.h"

#include <ATen/Parallel.h>
#include <ATen/Version.h>
#include <ATen/detail/CUDAHooksInterface.h>
#include <torch/version.h>

#include <sstream>

#include "model/core/running/threads.h"

namespace choreo {
namespace {

// The instruction set that LibTorch chose kernels for, such as "AVX512"; empty if it doesn't say.
std::string CpuCapability() {
  const std::string config = at::show_config();
  const std::string key = "CPU capability usage: ";
  const size_t at = config.find(key);
  if (at == std::string::npos) return "";
  const size_t begin = at + key.size();
  return config.substr(begin, config.find('\n', begin) - begin);
}

}  // namespace

std::string TorchKernels(const torch::Device& device) {
  const std::string torch = "torch " TORCH_VERSION ", ";
  if (device.is_cuda()) {  // a list; fingerprints need one line
    std::istringstream words(at::detail::getCUDAHooks().showConfig());
    std::string cuda;
    for (std::string word; words >> word;) cuda += word == "-" ? ", " : word + " ";
    return torch + device.str() + cuda;
  }
  return torch + DetectBlas().name + ", " + CpuCapability() + ", " +
         std::to_string(at::get_num_threads()) + " threads";
}

}  // namespace choreo
