#pragma once

#include <torch/nn/module.h>
#include <torch/types.h>

#include <string>
#include <vector>

#include "model/core/files/safetensors.h"

namespace choreo {

/// The Euclidean norm of all gradients together. Undefined ones count as zero.
double NormOf(const std::vector<torch::Tensor>& gradients);

/// Adam (Kingma & Ba 2015) over named parameters. Its moments are saved by name in the run's
/// safetensors and restored to the bit. torch's optimiser state cannot do that: it is keyed by
/// address, in a format that changes between releases. Not thread-safe.
class Adam {
 public:
  /// Optimises all parameters of `module`.
  explicit Adam(const torch::nn::Module& module);

  /// Clips the gradient's norm to `max_norm` (0: no clipping), then updates the parameters. Skips
  /// steps whose gradient is not finite.
  void Step(double learning_rate, double max_norm);
  void ZeroGrad();

  void Export(Safetensors* content) const;
  void Import(const Safetensors& content);

 private:
  struct Entry {
    std::string name;
    torch::Tensor parameter, first, second;
  };
  std::vector<Entry> entries_;
  int64_t steps_ = 0;
};

}  // namespace choreo
