#pragma once

#include <torch/nn/module.h>
#include <torch/types.h>

#include <string>
#include <vector>

#include "model/core/safetensors.h"

namespace choreo {

/// Euclidean norm of all of them together; those that are undefined are zero.
double NormOf(const std::vector<torch::Tensor>& gradients);

/// Adam (Kingma & Ba 2015) over named parameters. Our own because its moments go into the run's
/// safetensors by name and come back to the bit, which torch's optimiser state (keyed by address,
/// another format in each release) does not offer.
class Adam {
 public:
  /// All parameters of `module`.
  explicit Adam(const torch::nn::Module& module);

  /// Clips the gradient's norm to `max_norm` (0: leaves it), then updates. A gradient that is not
  /// finite changes nothing.
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
