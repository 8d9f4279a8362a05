#include <Eigen/Geometry>
#include <optional>

#include "model/core/error.h"
#include "model/formats/gltf/gltf.h"
#include "model/formats/gltf/gltf_scene.h"
#include "model/formats/reading/node_motion.h"
#include "model/formats/reading/own_skeleton.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// The nodes that are our joints; none if the file has another skeleton.
std::optional<std::vector<int>> FindOurs(const GltfNodes& file, const Skeleton& skeleton) {
  const Eigen::Matrix3Xd rest = PlacesOf(file.PlaceAtRest());
  std::vector<int> nodes;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const int node = IndexOf(file.names, skeleton.joint_names[joint]);
    if (node < 0) return std::nullopt;
    if (joint > 0) {
      const int parent = nodes[skeleton.parents[joint]];
      const Eigen::Vector3d offset = rest.col(node) - rest.col(parent);
      if (file.parents[node] != parent ||
          (offset - skeleton.offsets.col(joint)).norm() > kSameBone) {
        return std::nullopt;
      }
    }
    nodes.push_back(node);
  }
  return nodes;
}

Motion TakeOurs(const GltfScene& scene, const std::vector<int>& nodes, const Skeleton& skeleton) {
  const auto turn = [](const Eigen::Affine3d& transform) -> Eigen::Matrix3d {
    return transform.linear().colwise().normalized();
  };
  const std::vector<Eigen::Affine3d> rest = scene.nodes.PlaceAtRest();
  Motion motion;
  motion.fps = scene.fps;
  for (int64_t frame = 0; frame < scene.frames; ++frame) {
    const std::vector<Eigen::Affine3d> now = scene.Frame(frame);
    Pose& pose = motion.frames.emplace_back();
    pose.root_position = now[nodes[0]].translation();
    pose.rotations.resize(3, skeleton.joints());
    std::vector<Eigen::Matrix3d> since_rest;
    for (int joint = 0; joint < skeleton.joints(); ++joint) {
      since_rest.push_back(turn(now[nodes[joint]]) * turn(rest[nodes[joint]]).transpose());
      const int parent = skeleton.parents[joint];
      const Eigen::Matrix3d local =
          parent < 0 ? since_rest[joint] : since_rest[parent].transpose() * since_rest[joint];
      pose.rotations.col(joint) = LogMap(local);
    }
  }
  MakeContinuous(motion);
  return motion;
}

RigPlacement PlacementOf(const std::vector<Eigen::Affine3d>& world) {
  RigPlacement placement{PlacesOf(world), {}};
  for (const Eigen::Affine3d& node : world) {
    // A rotation cannot mirror, so a mirrored node turns like its image in its own x.
    Eigen::Affine3d turned = node;
    if (node.linear().determinant() < 0) turned.linear().col(0) *= -1;
    placement.turns.emplace_back(turned.rotation());
  }
  return placement;
}

Motion FitOthers(const GltfScene& scene, const MotionReading& reading) {
  NodeMotion motion{.fps = scene.fps, .count = scene.frames};
  if (scene.bound) motion.rests.push_back(PlacementOf(*scene.bound));
  motion.rests_apart = motion.rests.size();
  motion.rests.push_back(PlacementOf(scene.nodes.PlaceAtRest()));
  motion.frame = [&](int64_t frame) { return PlacementOf(scene.Frame(frame)); };
  return FitNodes(scene.rig, motion, reading);
}

}  // namespace

SkeletonMotion ReadGlb(const std::filesystem::path& path, const Skeleton* preferred,
                       const MotionReading& reading) {
  try {
    const GltfScene scene = ReadGltfScene(path, reading);
    const Skeleton& smpl = Skeleton::Smpl24();
    const GltfNodes& nodes = scene.nodes;
    const auto own = OwnSkeleton(nodes.names, nodes.parents, PlacesOf(nodes.PlaceAtRest()));
    for (const Skeleton* known : {preferred, &smpl, own ? &*own : nullptr}) {
      if (known == nullptr || reading.chooses()) continue;
      if (const auto ours = FindOurs(nodes, *known))
        return {*known, TakeOurs(scene, *ours, *known)};
    }
    return {smpl, FitOthers(scene, reading)};
  } catch (const UnknownBones& error) {
    throw UnknownBones(path.string(), error.missing(), error.rig(), error.found());
  } catch (const Error& error) {
    const bool option = error.field().starts_with("--") || !reading.bones.empty();
    if (error.code() == ErrorCode::kNotFound || option) throw;
    throw Error(error.code(), path.string(), error.what());
  }
}

}  // namespace choreo
