#include "model/formats/gltf/gltf_file.h"

#include <algorithm>
#include <cstring>

#include "model/core/files/json_limits.h"
#include "model/formats/gltf/glb_chunks.h"

namespace choreo {

std::string GltfItem(const char* list, size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

tinygltf::Model ParseGlb(std::string_view bytes) {
  CheckJsonDepth(SplitGlb(bytes).json, "");
  tinygltf::TinyGLTF gltf;
  // Opens no other files and decodes no pictures.
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
    throw InvalidArgument("", "is not a binary glTF: " + (error.empty() ? "bad header" : error));
  }
  return model;
}

namespace {

/// Reads a number from a buffer.
double Component(const unsigned char* at, int type) {
  const auto as = [at]<typename T>(T value) {
    std::memcpy(&value, at, sizeof(T));
    return static_cast<double>(value);
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return as(int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return as(uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return as(int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return as(uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return as(uint32_t{});
    default:
      return as(float{});
  }
}

// The integer that represents 1 in a normalised type; 0 for other types.
double One(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return 127;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 255;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return 32767;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 65535;
    default:
      return 0;
  }
}

/// Elements in a buffer view: an accessor's, or its sparse part's.
struct Elements {
  int view;
  uint64_t offset;
  int component;  ///< TINYGLTF_COMPONENT_TYPE
  int rows;
  uint64_t count;
};

Eigen::MatrixXd ReadElements(const tinygltf::Model& model, const Elements& elements,
                             const std::string& name) {
  const tinygltf::BufferView& view =
      GltfAt(model.bufferViews, elements.view, (name + ".bufferView").c_str());
  for (const char* packed : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (view.extensions.contains(packed)) {
      throw InvalidArgument(name, std::string("is compressed by ") + packed +
                                      ", which is not read: export it without compression");
    }
  }
  const tinygltf::Buffer& buffer = GltfAt(model.buffers, view.buffer, "buffers");
  const auto size =
      static_cast<uint64_t>(tinygltf::GetComponentSizeInBytes(uint32_t(elements.component)));
  const uint64_t width = static_cast<uint64_t>(elements.rows) * size;
  const uint64_t stride = view.byteStride == 0 ? width : view.byteStride;
  const uint64_t available = buffer.data.size();
  const uint64_t first = uint64_t{view.byteOffset} + elements.offset;
  if (elements.count < 1 || elements.count > available || first > available || stride < width ||
      stride > available || first + (elements.count - 1) * stride + width > available) {
    throw InvalidArgument(name,
                          "reaches beyond its buffer of " + std::to_string(available) + " bytes");
  }
  Eigen::MatrixXd values(elements.rows, static_cast<Eigen::Index>(elements.count));
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    for (Eigen::Index row = 0; row < values.rows(); ++row) {
      values(row, i) = Component(buffer.data.data() + first + static_cast<uint64_t>(i) * stride +
                                     static_cast<uint64_t>(row) * size,
                                 elements.component);
    }
  }
  return values;
}

// Replaces the elements given by a sparse accessor.
void ReadSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                const std::string& name, Eigen::MatrixXd* values) {
  const auto& sparse = accessor.sparse;
  const int indexed = sparse.indices.componentType;
  if (sparse.count < 1 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
      (indexed != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
       indexed != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
       indexed != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
    throw InvalidArgument(name + ".sparse", "has unknown counts or kinds");
  const auto count = static_cast<uint64_t>(sparse.count);
  const Eigen::MatrixXd at =
      ReadElements(model,
                   {.view = sparse.indices.bufferView,
                    .offset = static_cast<uint64_t>(sparse.indices.byteOffset),
                    .component = indexed,
                    .rows = 1,
                    .count = count},
                   name + ".sparse.indices");
  const Eigen::MatrixXd given =
      ReadElements(model,
                   {.view = sparse.values.bufferView,
                    .offset = static_cast<uint64_t>(sparse.values.byteOffset),
                    .component = accessor.componentType,
                    .rows = static_cast<int>(values->rows()),
                    .count = count},
                   name + ".sparse.values");
  for (Eigen::Index i = 0; i < at.cols(); ++i) {
    if (at(0, i) >= static_cast<double>(values->cols()))
      throw InvalidArgument(name + ".sparse.indices", "name elements that do not exist");
    values->col(static_cast<Eigen::Index>(at(0, i))) = given.col(i);
  }
}

}  // namespace

Eigen::MatrixXd ReadGltfAccessor(const tinygltf::Model& model, int index, int type) {
  const tinygltf::Accessor& accessor = GltfAt(model.accessors, index, "accessors");
  const std::string name = GltfItem("accessors", static_cast<size_t>(index));
  if (accessor.type != type) throw InvalidArgument(name, "has elements of another kind");
  const double one = One(accessor.componentType);
  if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && (one == 0 || !accessor.normalized))
    throw InvalidArgument(name, "has components that are neither floats nor normalized");
  const int rows = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type));
  Eigen::MatrixXd values;
  if (accessor.sparse.isSparse && accessor.bufferView < 0) {
    // A hostile file may claim any number of zeros, so limit it by the times, which take four bytes
    // each.
    uint64_t available = 0;
    for (const tinygltf::Buffer& buffer : model.buffers) available += buffer.data.size();
    if (accessor.count < 1 || accessor.count > available)
      throw InvalidArgument(name, "has more elements than the file has bytes");
    values.setZero(rows, static_cast<Eigen::Index>(accessor.count));
  } else {
    values = ReadElements(model,
                          {.view = accessor.bufferView,
                           .offset = accessor.byteOffset,
                           .component = accessor.componentType,
                           .rows = rows,
                           .count = accessor.count},
                          name);
  }
  if (accessor.sparse.isSparse) ReadSparse(model, accessor, name, &values);
  if (one > 0) values = (values / one).cwiseMax(-1.0);
  if (!values.allFinite()) throw InvalidArgument(name, "holds values that are not finite");
  return values;
}

}  // namespace choreo
