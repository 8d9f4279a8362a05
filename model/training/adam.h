#pragma once

#include <torch/nn/module.h>
#include <torch/types.h>

#include <string>
#include <vector>

#include "model/core/safetensors.h"

namespace choreo {

/// Their Euclidean norm together; undefined ones count as zero.
double NormOf(const std::vector<torch::Tensor>& gradients);

/// Adam (Kingma & Ba 2015) over named parameters. Ours, because its moments are saved in the run's
/// safetensors by name and restored to the bit, which torch's optimiser state (keyed by address, in
/// a format that changes between releases) does not offer.
class Adam {
 public:
  /// All parameters of `module`.
  explicit Adam(const torch::nn::Module& module);

  /// Clips the gradient's norm to `max_norm` (0: no clipping), then updates. Skips gradients that
  /// are not finite.
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
