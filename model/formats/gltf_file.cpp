#include "model/formats/gltf_file.h"

#include <algorithm>
#include <cstring>

#include "model/core/json_limits.h"
#include "model/formats/glb_chunks.h"

namespace choreo {

std::string GltfItem(const char* list, size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

tinygltf::Model ParseGlb(std::string_view bytes) {
  CheckJsonDepth(SplitGlb(bytes).json, "");
  tinygltf::TinyGLTF gltf;
  // A motion comes from one file: no others are opened, and pictures are not looked at.
  gltf.SetFsCallbacks(
      {[](const std::string&, void*) { return false; },
       [](const std::string& name, void*) { return name; },
       [](std::vector<unsigned char>*, std::string* error, const std::string& name, void*) {
         if (error) *error += "the file beside it, " + name + ", is not read";
         return false;
       },
       [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
         return false;
       },
       nullptr});
  gltf.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                         const unsigned char*, int, void*) { return true; },
                      nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  if (!gltf.LoadBinaryFromMemory(&model, &error, &warning, data,
                                 static_cast<unsigned>(bytes.size()))) {
    error.erase(std::find(error.begin(), error.end(), '\n'), error.end());
    throw InvalidArgument("", "is no binary glTF: " + (error.empty() ? "bad header" : error));
  }
  return model;
}

Eigen::MatrixXd ReadGltfAccessor(const tinygltf::Model& model, int index, int type) {
  const tinygltf::Accessor& accessor = GltfAt(model.accessors, index, "accessors");
  const std::string name = GltfItem("accessors", static_cast<size_t>(index));
  if (accessor.sparse.isSparse) throw InvalidArgument(name, "is sparse, which is not read");
  if (accessor.type != type) throw InvalidArgument(name, "has elements of another kind");
  const tinygltf::BufferView& view =
      GltfAt(model.bufferViews, accessor.bufferView, (name + ".bufferView").c_str());
  for (const char* packed : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (view.extensions.contains(packed)) {
      throw InvalidArgument(name, std::string("is compressed by ") + packed +
                                      ", which is not read: export it without compression");
    }
  }
  const tinygltf::Buffer& buffer = GltfAt(model.buffers, view.buffer, "buffers");
  const int rows = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type));
  const int size = tinygltf::GetComponentSizeInBytes(accessor.componentType);
  const int stride = accessor.ByteStride(view);
  const bool integer = accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (size < 1 || stride < rows * size || (integer && (!accessor.normalized || size > 2))) {
    throw InvalidArgument(name, "has components that are neither floats nor normalized");
  }
  const uint64_t available = buffer.data.size();
  const uint64_t first = uint64_t{view.byteOffset} + accessor.byteOffset;
  if (accessor.count < 1 || accessor.count > available || first > available ||
      first + (accessor.count - 1) * stride + rows * size > available) {
    throw InvalidArgument(name,
                          "reaches beyond its buffer of " + std::to_string(available) + " bytes");
  }
  const auto component = [&](const unsigned char* at) -> double {
    const auto as = [at]<typename T>(T value) {
      std::memcpy(&value, at, sizeof(T));
      return static_cast<double>(value);
    };
    switch (accessor.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return std::max(as(int8_t{}) / 127, -1.0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return as(uint8_t{}) / 255;
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return std::max(as(int16_t{}) / 32767, -1.0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return as(uint16_t{}) / 65535;
      default:
        return as(float{});
    }
  };
  Eigen::MatrixXd values(rows, static_cast<Eigen::Index>(accessor.count));
  for (size_t i = 0; i < accessor.count; ++i) {
    for (int row = 0; row < rows; ++row) {
      const size_t offset = first + i * stride + row * size;
      values(row, i) = component(buffer.data.data() + offset);
    }
  }
  if (!values.allFinite()) throw InvalidArgument(name, "holds values that are not finite");
  return values;
}

}  // namespace choreo
