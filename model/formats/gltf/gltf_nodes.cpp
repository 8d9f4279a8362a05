#include "model/formats/gltf/gltf_nodes.h"

#include <sstream>
#include <utility>

#include "model/formats/gltf/gltf_file.h"
#include "model/motion/pose/pose_limits.h"

namespace choreo {
namespace {

GltfPlacement ReadPlacement(const tinygltf::Node& node, const std::string& name) {
  GltfPlacement placement;
  if (node.matrix.size() == 16) {
    const Eigen::Affine3d transform(Eigen::Map<const Eigen::Matrix4d>(node.matrix.data()));
    Eigen::Matrix3d rotation, scaling;
    transform.computeRotationScaling(&rotation, &scaling);
    placement.translation = transform.translation();
    placement.rotation = Eigen::Quaterniond(rotation);
    placement.scale = scaling.diagonal();
  }
  if (node.translation.size() == 3)
    placement.translation = Eigen::Map<const Eigen::Vector3d>(node.translation.data());
  if (node.rotation.size() == 4)
    placement.rotation =
        Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(node.rotation.data())).normalized();
  if (node.scale.size() == 3)
    placement.scale = Eigen::Map<const Eigen::Vector3d>(node.scale.data());
  if (!placement.Transform().matrix().allFinite())
    throw InvalidArgument(name, "has a placement that is not finite");
  return placement;
}

}  // namespace

Eigen::Matrix3Xd PlacesOf(const std::vector<Eigen::Affine3d>& world) {
  Eigen::Matrix3Xd places(3, std::ssize(world));
  for (size_t node = 0; node < world.size(); ++node) places.col(node) = world[node].translation();
  return places;
}

GltfNodes ReadGltfNodes(const tinygltf::Model& model) {
  const size_t count = model.nodes.size();
  GltfNodes nodes;
  nodes.parents.assign(count, -1);
  for (size_t i = 0; i < count; ++i) {
    const tinygltf::Node& node = model.nodes[i];
    nodes.names.push_back(node.name);
    nodes.rest.push_back(ReadPlacement(node, GltfItem("nodes", i)));
    for (const int child : node.children) {
      GltfAt(model.nodes, child, "nodes");
      if (std::exchange(nodes.parents[child], static_cast<int>(i)) >= 0)
        throw InvalidArgument(GltfItem("nodes", child), "has two parents");
    }
  }
  for (size_t i = 0; i < count; ++i) {
    if (nodes.parents[i] < 0) nodes.order.push_back(i);
  }
  for (size_t i = 0; i < nodes.order.size(); ++i) {
    const std::vector<int>& children = model.nodes[nodes.order[i]].children;
    nodes.order.insert(nodes.order.end(), children.begin(), children.end());
  }
  if (nodes.order.size() != count) throw InvalidArgument("nodes", "some are their own ancestors");
  return nodes;
}

std::vector<Eigen::Affine3d> GltfNodes::Place(const std::vector<GltfPlacement>& local) const {
  std::vector<Eigen::Affine3d> world(local.size());
  for (const size_t node : order) {
    world[node] = local[node].Transform();
    if (parents[node] >= 0) world[node] = world[parents[node]] * world[node];
    const double distance = world[node].translation().cwiseAbs().maxCoeff();
    if (!(distance <= kMaxPosition)) {
      std::ostringstream message;
      message << "stands at " << distance << " m, further than " << kMaxPosition
              << " m from the origin";
      throw InvalidArgument(GltfItem("nodes", node), message.str());
    }
  }
  return world;
}

}  // namespace choreo
