#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/formats/gltf_nodes.h"

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
  /// [3 or 4, keys] per second, for kCubic: the tangents before and after each key
  Eigen::MatrixXd arrives = {}, leaves = {};

  /// Sets its property at `time`, holding the first and the last key outside.
  void Drive(double time, GltfPlacement& placement) const;
  /// Whether it has keys that differ.
  bool Moves() const;
};

/// The channels of one of the file's animations. Throws Error(kInvalidArgument) naming a faulty
/// part. Private to this folder, like the above.
std::vector<GltfChannel> ReadGltfChannels(const tinygltf::Model& model, size_t animation);

}  // namespace choreo
