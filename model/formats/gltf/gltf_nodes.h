#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace choreo {

/// The largest number of node positions in all frames read or written, about a gigabyte, whatever a
/// small file claims.
inline constexpr double kMaxPlaces = 3e7;

/// A node's transform relative to its parent.
struct GltfPlacement {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();

  Eigen::Affine3d Transform() const {
    return Eigen::Translation3d(translation) * rotation * Eigen::Scaling(scale);
  }
};

/// The nodes' positions, [3, nodes].
Eigen::Matrix3Xd PlacesOf(const std::vector<Eigen::Affine3d>& world);

/// The nodes of a glTF file.
struct GltfNodes {
  std::vector<std::string> names;  ///< may be empty or duplicate
  std::vector<int> parents;        ///< -1: none
  std::vector<size_t> order;       ///< all nodes, parents first
  std::vector<GltfPlacement> rest;

  /// World transforms of all nodes. Throws Error(kInvalidArgument) for a node beyond the limits of
  /// motions (motion/pose/pose_limits.h).
  std::vector<Eigen::Affine3d> Place(const std::vector<GltfPlacement>& local) const;
  std::vector<Eigen::Affine3d> PlaceAtRest() const { return Place(rest); }
};

/// Throws Error(kInvalidArgument), naming the node, if it has two parents, is its own ancestor, or
/// has a placement that is not finite.
GltfNodes ReadGltfNodes(const tinygltf::Model& model);

}  // namespace choreo
