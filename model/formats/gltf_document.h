#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "model/fit/find_bones.h"
#include "model/formats/gltf_file.h"

/// Of a glTF's JSON what motions and characters need. Private to this folder.
namespace choreo {

/// The JSON of a binary glTF. Throws Error(kInvalidArgument) without a field where it is none, or
/// is nested too deeply.
nlohmann::ordered_json ParseGltfJson(std::string_view glb);

enum class GltfPart {
  kNodes,   ///< and the joints of skins
  kMotion,  ///< animations, bind poses and the numbers of both, too
};

/// These parts alone: of others the parser would refuse what it does not know, such as compressed
/// meshes. Throws Error(kInvalidArgument) naming what is none.
tinygltf::Model ParseGltfPart(const nlohmann::ordered_json& document, std::string_view glb,
                              GltfPart part);

/// Names, parents and places at rest of all nodes, which of them hold meshes, which are joints of a
/// skin, and what the tables of VRM 0.x, VRM 1.0 and VRM's animations call them. Nothing moves.
RigNodes ReadRigNodes(const nlohmann::ordered_json& document, const tinygltf::Model& model);

}  // namespace choreo
