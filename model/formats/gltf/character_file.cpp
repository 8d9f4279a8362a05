#include "model/formats/gltf/character_file.h"

#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/formats/gltf/glb_chunks.h"
#include "model/formats/gltf/gltf_document.h"

namespace choreo {
namespace {

using nlohmann::ordered_json;

void RequireOneFile(const ordered_json& document) {
  const auto buffers = document.find("buffers");
  if (buffers == document.end() || !buffers->is_array() || buffers->empty()) return;
  if (!buffers->front().is_object()) throw InvalidArgument("buffers[0]", "is not an object");
  if (buffers->front().contains("uri")) {
    throw InvalidArgument("buffers[0].uri",
                          "its data lie elsewhere; export the character as one file, glTF binary");
  }
}

}  // namespace

CharacterFile::CharacterFile(const std::filesystem::path& path) : path_(path) {
  try {
    bytes_ = ReadGlbBytes(path);
    const ordered_json document = ParseGltfJson(bytes_);
    const tinygltf::Model model = ParseGltfPart(document, bytes_, GltfPart::kNodes);
    RequireOneFile(document);
    nodes_ = ReadGltfNodes(model);
    rig_ = ReadRigNodes(document, model);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kNotFound) throw;
    throw Error(error.code(), path.string(), error.what());
  }
}

}  // namespace choreo
