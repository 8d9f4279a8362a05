#include <Eigen/Geometry>
#include <optional>

#include "model/fit/bvh_source.h"
#include "model/fit/fit_clip.h"
#include "model/formats/gltf.h"
#include "model/formats/gltf_scene.h"
#include "model/formats/own_skeleton.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kSameRest = 0.002;  // metres

// The nodes that are our joints, or nothing if the file's skeleton is another one.
std::optional<std::vector<int>> FindOurs(const GltfScene& scene, const Skeleton& skeleton) {
  const std::vector<Eigen::Affine3d> rest = scene.Rest();
  std::vector<int> nodes;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const int node = scene.Find(skeleton.joint_names[joint]);
    if (node < 0) return std::nullopt;
    if (joint > 0) {
      const int parent = nodes[skeleton.parents[joint]];
      const Eigen::Vector3d offset = rest[node].translation() - rest[parent].translation();
      if (scene.parent(node) != parent ||
          (offset - skeleton.offsets.col(joint)).norm() > kSameRest) {
        return std::nullopt;
      }
    }
    nodes.push_back(node);
  }
  return nodes;
}

std::optional<Skeleton> FindOwn(const GltfScene& scene) {
  const std::vector<Eigen::Affine3d> rest = scene.Rest();
  std::vector<int> parents;
  Eigen::Matrix3Xd places(3, std::ssize(rest));
  for (int node = 0; node < std::ssize(rest); ++node) {
    parents.push_back(scene.parent(node));
    places.col(node) = rest[static_cast<size_t>(node)].translation();
  }
  return OwnSkeleton(scene.names(), parents, places);
}

Motion TakeOurs(const GltfScene& scene, const std::vector<int>& nodes, const Skeleton& skeleton) {
  const auto turn = [](const Eigen::Affine3d& transform) -> Eigen::Matrix3d {
    return transform.linear().colwise().normalized();
  };
  const std::vector<Eigen::Affine3d> rest = scene.Rest();
  Motion motion;
  motion.fps = scene.fps();
  for (int64_t frame = 0; frame < scene.frames(); ++frame) {
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

Motion FitOthers(const GltfScene& scene, const Skeleton& skeleton) {
  PositionClip clip;
  clip.fps = scene.fps();
  clip.joint_names = scene.names();
  for (int64_t frame = 0; frame < scene.frames(); ++frame) {
    const std::vector<Eigen::Affine3d> now = scene.Frame(frame);
    Eigen::Matrix3Xd& positions = clip.frames.emplace_back(3, now.size());
    for (size_t node = 0; node < now.size(); ++node)
      positions.col(static_cast<Eigen::Index>(node)) = now[node].translation();
  }
  return FitClip(clip, BvhSource(clip), skeleton).motion;
}

}  // namespace

SkeletonMotion ReadGlb(const std::filesystem::path& path, const Skeleton* wanted) {
  try {
    const GltfScene scene(ParseGlb(path));
    const Skeleton& smpl = Skeleton::Smpl24();
    const auto own = FindOwn(scene);
    for (const Skeleton* known : {wanted, &smpl, own ? &*own : nullptr}) {
      if (known == nullptr) continue;
      if (const auto nodes = FindOurs(scene, *known))
        return {*known, TakeOurs(scene, *nodes, *known)};
    }
    return {smpl, FitOthers(scene, smpl)};
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kNotFound) throw;
    throw Error(error.code(), path.string(), error.what());
  }
}

}  // namespace choreo
