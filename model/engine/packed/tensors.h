#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/core/safetensors.h"
#include "model/engine/packed/matrix.h"

namespace choreo {

/// A checkpoint's tensors by name, as the packed engine packs them. Throws Error(kInvalidArgument)
/// naming a tensor that is missing or does not fit the configuration.
class PackedTensors {
 public:
  /// `content` must outlive this.
  explicit PackedTensors(const Safetensors& content) : content_(content) {}

  Eigen::Map<const RowMajorMatrix> Get(const std::string& name, long rows, long columns) const;
  Eigen::Map<const Eigen::VectorXf> Get(const std::string& name, long size) const;
  /// Floats of a tensor of any such shape.
  const std::vector<float>& Get(const std::string& name, const std::vector<int64_t>& shape) const;
  /// Columns of a matrix, whatever their number; 0 where there is no such matrix.
  long Columns(const std::string& name) const;

  /// A linear layer `name`.weight, `name`.bias of LibTorch's, which holds [out, in].
  PackedLinear Linear(const PackedKernels& kernels, const std::string& name, long in,
                      long out) const;

 private:
  const Safetensors& content_;
};

}  // namespace choreo
