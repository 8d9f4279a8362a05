#pragma once

#include <tiny_gltf.h>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/error.h"

/// Reads .glb with tinygltf and checks every index and range. Private to this folder.
namespace choreo {

/// The name of an element in messages: "list[3]".
std::string GltfItem(const char* list, size_t index);

/// Returns the element. Throws Error(kInvalidArgument), whose field is `name`, if there is none.
template <typename T>
const T& GltfAt(const std::vector<T>& list, int index, const char* name) {
  if (index < 0 || static_cast<size_t>(index) >= list.size()) {
    throw InvalidArgument(name, "there is no number " + std::to_string(index) + " among " +
                                    std::to_string(list.size()));
  }
  return list[static_cast<size_t>(index)];
}

/// Parses a glb without opening other files or decoding pictures. Throws Error(kInvalidArgument)
/// without a field.
tinygltf::Model ParseGlb(std::string_view bytes);

/// Reads an accessor's elements, [components, count], sparse or not. Normalised integers become -1
/// to 1. `type` is a TINYGLTF_TYPE. Throws Error(kInvalidArgument), naming the accessor.
Eigen::MatrixXd ReadGltfAccessor(const tinygltf::Model& model, int index, int type);

}  // namespace choreo
