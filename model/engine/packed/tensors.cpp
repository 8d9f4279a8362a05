#include "model/engine/packed/tensors.h"

#include "model/core/error.h"

namespace choreo {

const std::vector<float>& PackedTensors::Get(const std::string& name,
                                             const std::vector<int64_t>& shape) const {
  const auto found = content_.tensors.find(name);
  if (found == content_.tensors.end()) throw InvalidArgument(name, "the file has no such tensor");
  if (found->second.shape != shape) {
    throw InvalidArgument(name, "its shape does not fit the configuration");
  }
  return found->second.data;
}

Eigen::Map<const RowMajorMatrix> PackedTensors::Get(const std::string& name, long rows,
                                                    long columns) const {
  return {Get(name, std::vector<int64_t>{rows, columns}).data(), rows, columns};
}

Eigen::Map<const Eigen::VectorXf> PackedTensors::Get(const std::string& name, long size) const {
  return {Get(name, std::vector<int64_t>{size}).data(), size};
}

long PackedTensors::Columns(const std::string& name) const {
  const auto found = content_.tensors.find(name);
  const bool matrix = found != content_.tensors.end() && found->second.shape.size() == 2;
  return matrix ? found->second.shape[1] : 0;
}

PackedLinear PackedTensors::Linear(const PackedKernels& kernels, const std::string& name, long in,
                                   long out) const {
  return {kernels, Get(name + ".weight", out, in).transpose(), Get(name + ".bias", out)};
}

}  // namespace choreo
