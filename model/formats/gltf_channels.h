#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/formats/gltf_nodes.h"

namespace tinygltf {
class Model;
}

namespace choreo {

/// What an animation does to a node.
struct GltfChannel {
  enum class Path { kTranslation, kRotation, kScale };
  enum class Way { kLinear, kStep, kCubic };
  size_t node = 0;
  Path path = Path::kTranslation;
  Way way = Way::kLinear;
  Eigen::RowVectorXd times;  ///< [keys] ascending, seconds
  Eigen::MatrixXd values;    ///< [3 or 4, keys]
  /// [3 or 4, keys] a second, of kCubic: in which way a curve comes to a key, and leaves it
  Eigen::MatrixXd arrives = {}, leaves = {};

  /// Sets what it drives to its value at `time`; before the first and after the last key it holds.
  void Drive(double time, GltfPlacement& placement) const;
  /// Whether it has keys that differ.
  bool Moves() const;
};

/// Of one of the file's animations, what moves nodes. Throws Error(kInvalidArgument) naming the
/// part that is odd. Private to this folder, as the above.
std::vector<GltfChannel> ReadGltfChannels(const tinygltf::Model& model, size_t animation);

}  // namespace choreo
