#pragma once

#include <torch/types.h>

#include <string>

namespace choreo {

/// Everything that can change a bit of what LibTorch computes there, but for the weights, as part
/// of a fingerprint: "torch 2.1.2, openblas, AVX512, 1 threads".
std::string TorchKernels(const torch::Device& device);

}  // namespace choreo
