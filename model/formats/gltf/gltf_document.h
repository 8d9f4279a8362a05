#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "model/fit/bones/find_bones.h"
#include "model/formats/gltf/gltf_file.h"

/// The parts of a glTF's JSON that motions and characters need. Private to this folder.
namespace choreo {

/// The JSON of a binary glTF. Throws Error(kInvalidArgument), without a field, if it is invalid or
/// nested too deeply.
nlohmann::ordered_json ParseGltfJson(std::string_view glb);

enum class GltfPart {
  kNodes,   ///< nodes and the joints of skins
  kMotion,  ///< also animations, bind poses and their data
};

/// Parses only these parts, because the parser refuses unknown ones, such as compressed meshes.
/// Throws Error(kInvalidArgument), naming an invalid part.
tinygltf::Model ParseGltfPart(const nlohmann::ordered_json& document, std::string_view glb,
                              GltfPart part);

/// Reads all nodes: names, parents, rest positions, which hold meshes or are joints of a skin, and
/// the bones that the tables of VRM 0.x, VRM 1.0 or VRM animations name. Sets `moves` false for
/// all.
RigNodes ReadRigNodes(const nlohmann::ordered_json& document, const tinygltf::Model& model);

}  // namespace choreo
