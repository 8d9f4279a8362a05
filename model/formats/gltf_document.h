#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "model/fit/find_bones.h"
#include "model/formats/gltf_file.h"

/// The parts of a glTF's JSON that motions and characters need. Private to this folder.
namespace choreo {

/// The JSON of a binary glTF. Throws Error(kInvalidArgument) without a field if it is invalid, or
/// nested too deeply.
nlohmann::ordered_json ParseGltfJson(std::string_view glb);

enum class GltfPart {
  kNodes,   ///< and the joints of skins
  kMotion,  ///< also animations, bind poses and their numbers
};

/// Parses only these parts: the parser would refuse what it does not know, such as compressed
/// meshes. Throws Error(kInvalidArgument) naming an invalid part.
tinygltf::Model ParseGltfPart(const nlohmann::ordered_json& document, std::string_view glb,
                              GltfPart part);

/// Names, parents and rest places of all nodes, which of them hold meshes or are joints of a skin,
/// and their names in the tables of VRM 0.x, VRM 1.0 and VRM's animations. Nothing moves.
RigNodes ReadRigNodes(const nlohmann::ordered_json& document, const tinygltf::Model& model);

}  // namespace choreo
