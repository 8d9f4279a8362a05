#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "model/formats/gltf_nodes.h"

namespace choreo {

/// What an animation does to a node.
struct GltfChannel {
  enum class Path { kTranslation, kRotation, kScale };
  size_t node = 0;
  Path path = Path::kTranslation;
  bool step = false;
  Eigen::RowVectorXd times;  ///< [keys] ascending, seconds
  Eigen::MatrixXd values;    ///< [3 or 4, keys]

  /// Sets what it drives to its value at `time`; before the first and after the last key it holds.
  void Drive(double time, GltfPlacement& placement) const;
};

/// The nodes of a glTF file and how its first animation moves them. Private to this folder.
struct GltfScene {
  GltfNodes nodes;
  std::vector<GltfChannel> channels;
  double fps = 0;
  double start = 0;  ///< seconds
  int64_t frames = 0;

  /// Where all nodes are in the world.
  std::vector<Eigen::Affine3d> Frame(int64_t frame) const;
};

/// Throws Error(kNotFound) naming the path, and Error(kInvalidArgument) naming the part, for what
/// gltf.h says.
GltfScene ReadGltfScene(const std::filesystem::path& path);

}  // namespace choreo
