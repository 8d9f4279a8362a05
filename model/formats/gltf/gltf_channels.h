#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/formats/gltf/gltf_nodes.h"

namespace tinygltf {
class Model;
}

namespace choreo {

/// One channel of an animation.
struct GltfChannel {
  enum class Path { kTranslation, kRotation, kScale };
  enum class Interpolation { kLinear, kStep, kCubic };
  size_t node = 0;
  Path path = Path::kTranslation;
  Interpolation interpolation = Interpolation::kLinear;
  Eigen::RowVectorXd times;  ///< [keys] ascending, seconds
  Eigen::MatrixXd values;    ///< [3 or 4, keys]
  /// [3 or 4, keys], per second, for kCubic: the tangents before and after each key.
  Eigen::MatrixXd arrives = {}, leaves = {};

  /// Sets the animated property at `time`, seconds. Holds the first and the last key outside.
  void Drive(double time, GltfPlacement& placement) const;
  /// Whether any keys differ.
  bool Moves() const;
};

/// Reads the channels of one animation. Throws Error(kInvalidArgument), naming a faulty part.
/// Private to this folder, like GltfChannel.
std::vector<GltfChannel> ReadGltfChannels(const tinygltf::Model& model, size_t animation);

}  // namespace choreo
