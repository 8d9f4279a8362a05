#pragma once

#include <tiny_gltf.h>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/error.h"

/// Reads .glb with tinygltf, checking every index and range. Private to this folder.
namespace choreo {

/// "list[3]".
std::string GltfItem(const char* list, size_t index);

/// Returns the element, or throws Error(kInvalidArgument) whose field is `name`.
template <typename T>
const T& GltfAt(const std::vector<T>& list, int index, const char* name) {
  if (index < 0 || static_cast<size_t>(index) >= list.size()) {
    throw InvalidArgument(name, "there is no number " + std::to_string(index) + " among " +
                                    std::to_string(list.size()));
  }
  return list[static_cast<size_t>(index)];
}

/// Opens no file and decodes no pictures. Throws Error(kInvalidArgument) without a field.
tinygltf::Model ParseGlb(std::string_view bytes);

/// An accessor's elements, [components, count], sparse or not; normalised integers become -1 to 1.
/// `type` is a TINYGLTF_TYPE. Throws Error(kInvalidArgument) naming the accessor.
Eigen::MatrixXd ReadGltfAccessor(const tinygltf::Model& model, int index, int type);

}  // namespace choreo
