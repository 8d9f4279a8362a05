#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "model/formats/gltf_file.h"

namespace choreo {

/// Places of nodes in frames that are read or written: a gigabyte, whatever a small file claims.
inline constexpr double kMaxPlaces = 3e7;

/// Where a node stands in its parent.
struct GltfPlacement {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();

  Eigen::Affine3d Transform() const {
    return Eigen::Translation3d(translation) * rotation * Eigen::Scaling(scale);
  }
};

/// [3, nodes]
Eigen::Matrix3Xd PlacesOf(const std::vector<Eigen::Affine3d>& world);

/// The nodes of a glTF file, at rest. Immutable. Private to this folder.
class GltfNodes {
 public:
  /// Throws Error(kInvalidArgument) naming the node: two parents, its own ancestor, a placement
  /// that is not finite.
  explicit GltfNodes(const tinygltf::Model& model);

  const std::vector<std::string>& names() const { return names_; }
  const std::vector<int>& parents() const { return parents_; }  ///< -1: none
  const std::vector<size_t>& order() const { return order_; }   ///< all nodes, parents first
  const std::vector<GltfPlacement>& rest() const { return rest_; }

  /// Where all nodes are in the world. Throws Error(kInvalidArgument) for one that is further away
  /// than any motion goes.
  std::vector<Eigen::Affine3d> Place(const std::vector<GltfPlacement>& local) const;
  /// The same at rest.
  std::vector<Eigen::Affine3d> PlaceAtRest() const { return Place(rest_); }

 private:
  std::vector<std::string> names_;
  std::vector<int> parents_;
  std::vector<size_t> order_;
  std::vector<GltfPlacement> rest_;
};

}  // namespace choreo
