#pragma once

#include <Eigen/Core>
#include <string>

#include "model/core/safetensors.h"
#include "model/engine/packed/matrix.h"

namespace choreo {

/// A checkpoint's tensors by name, as the packed engine packs them. Throws Error(kInvalidArgument)
/// naming a tensor that is missing or does not fit the configuration.
class PackedTensors {
 public:
  /// `content` must outlive this.
  explicit PackedTensors(const Safetensors& content) : content_(content) {}

  Eigen::Map<const RowMajorMatrix> Get(const std::string& name, long rows, long columns) const {
    return {content_.Get(name, {rows, columns}).data.data(), rows, columns};
  }
  Eigen::Map<const Eigen::VectorXf> Get(const std::string& name, long size) const {
    return {content_.Get(name, {size}).data.data(), size};
  }
  /// A linear layer `name`.weight, `name`.bias of LibTorch's, which holds [out, in].
  PackedLinear Linear(const PackedKernels& kernels, const std::string& name, long in,
                      long out) const {
    return {kernels, Get(name + ".weight", out, in).transpose(), Get(name + ".bias", out)};
  }

 private:
  const Safetensors& content_;
};

}  // namespace choreo
