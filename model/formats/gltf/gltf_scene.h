#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "model/fit/bones/find_bones.h"
#include "model/formats/gltf/gltf_channels.h"
#include "model/formats/gltf/gltf_nodes.h"
#include "model/formats/reading/motion_reading.h"

namespace choreo {

/// The nodes of a glTF file and one of its animations. Private to this folder.
struct GltfScene {
  GltfNodes nodes;
  RigNodes rig;  ///< the nodes for finding bones; `moves`: the nodes that the animation moves
  /// The nodes' world transforms in the bind pose of the first skin that has most of the body's
  /// bones. None without a skin.
  std::optional<std::vector<Eigen::Affine3d>> bound;
  std::vector<GltfChannel> channels;
  double fps = 0;
  double start = 0;  ///< seconds
  int64_t frames = 0;

  /// World transforms of all nodes.
  std::vector<Eigen::Affine3d> Frame(int64_t frame) const;
};

/// Reads the animation that `reading` names, or else the first that moves most of a body's bones.
/// Throws what ReadGlb throws, Error(kNotFound) naming the path and Error(kInvalidArgument) naming
/// the part.
GltfScene ReadGltfScene(const std::filesystem::path& path, const MotionReading& reading = {});

}  // namespace choreo
