#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/formats/character_file.h"
#include "model/formats/glb_chunks.h"
#include "model/formats/gltf_nodes.h"

namespace choreo {

/// Private to this folder.
struct CharacterFile::Contents {
  std::filesystem::path path;
  std::string bytes;
  GlbChunks chunks;  // of `bytes`
  nlohmann::ordered_json document;
  GltfNodes nodes;
  std::vector<bool> joints;
};

}  // namespace choreo
