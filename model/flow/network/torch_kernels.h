#pragma once

#include <torch/types.h>

#include <string>

namespace choreo {

/// A fingerprint's part for all but weights that can change LibTorch's bits: "torch 2.1.2,
/// openblas, AVX512, 1 threads".
std::string TorchKernels(const torch::Device& device);

}  // namespace choreo
