#include <Eigen/Geometry>
#include <algorithm>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/rounded.h"
#include "model/formats/arrays/own_arrays.h"
#include "model/formats/gltf/character_file.h"
#include "model/formats/gltf/glb_chunks.h"
#include "model/formats/gltf/gltf_builder.h"
#include "model/formats/gltf/gltf_file.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

using nlohmann::ordered_json;

constexpr double kFlattest = 1e-6;  // share of a node's largest scale that counts as zero

/// The tracks of the nodes that a body moves.
class DrivenNodes {
 public:
  DrivenNodes(const GltfNodes& nodes, const CharacterBody& body)
      : nodes_(nodes),
        body_(body),
        local_(nodes.rest),
        rest_(nodes.PlaceAtRest()),
        world_(rest_),
        joint_of_(nodes.names.size(), -1) {
    // The nodes of the bones and all their ancestors.
    std::vector<bool> needed(nodes.names.size());
    for (size_t joint = 0; joint < body.nodes.size(); ++joint) {
      if (body.nodes[joint] >= 0) joint_of_[body.nodes[joint]] = static_cast<int>(joint);
      for (int node = body.nodes[joint]; node >= 0; node = nodes.parents[node]) needed[node] = true;
    }
    for (const size_t node : nodes.order) {
      if (!needed[node]) continue;
      order_.push_back(node);
      if (joint_of_[node] >= 0) RequireVolume(node);
    }
    for (size_t joint = 0; joint < body.nodes.size(); ++joint)
      moves_.push_back(body.nodes[joint] >= 0 && Moves(joint));
  }

  size_t size() const { return order_.size(); }
  /// Whether a joint's node moves relative to its parent.
  bool moves(size_t joint) const { return moves_[joint]; }
  const GltfPlacement& local(size_t joint) const { return local_[body_.nodes[joint]]; }

  void Pose(const choreo::Pose& pose) {
    ForwardKinematics(body_.skeleton, pose, placement_);
    for (const size_t node : order_) {
      const int parent = nodes_.parents[node];
      const Eigen::Affine3d above = parent < 0 ? Eigen::Affine3d::Identity() : world_[parent];
      GltfPlacement& local = local_[node];
      if (joint_of_[node] >= 0) {
        const int joint = joint_of_[node];
        const Eigen::Matrix3d rest = rest_[node].linear();
        const Eigen::Matrix3d turned = placement_.rotations[joint] * body_.turns[joint] * rest;
        const Eigen::Matrix3d inside =
            above.linear().inverse() * turned * local.scale.cwiseInverse().asDiagonal();
        // The nearest rotation, as scales may differ by axis.
        local.rotation = Eigen::Quaterniond(Eigen::Affine3d(inside).rotation());
        if (moves_[joint])
          local.translation = above.inverse() * Eigen::Vector3d(placement_.positions.col(joint));
      }
      world_[node] = above * local.Transform();
    }
  }

 private:
  void RequireVolume(size_t node) const {
    const Eigen::JacobiSVD<Eigen::Matrix3d> shape(world_[node].linear());
    const Eigen::Vector3d sizes = shape.singularValues();
    if (sizes[2] > kFlattest * sizes[0] && sizes[2] > 1e-9 && local_[node].scale.allFinite())
      return;
    throw InvalidArgument(GltfItem("nodes", node), "has a scale of zero");
  }

  // Whether a bone needs a track for its position: the pelvis, and a bone whose parent node is not
  // the bone above it.
  bool Moves(size_t joint) const {
    const int above = body_.skeleton.parents[joint];
    if (above < 0) return true;
    int node = nodes_.parents[body_.nodes[joint]];
    while (node >= 0 && joint_of_[node] < 0) node = nodes_.parents[node];
    return node < 0 || joint_of_[node] != above;
  }

  const GltfNodes& nodes_;
  const CharacterBody& body_;
  std::vector<GltfPlacement> local_;
  const std::vector<Eigen::Affine3d> rest_;  // in the world
  std::vector<Eigen::Affine3d> world_;
  std::vector<int> joint_of_;  // [nodes] -1: none
  std::vector<size_t> order_;  // parents first
  std::vector<bool> moves_;    // [joints]
  JointPlacement placement_;
};

// The rotation of a finger's node relative to its parent.
Eigen::Quaterniond Curled(const CurledBone& finger, double angle, const GltfNodes& nodes,
                          const std::vector<Eigen::Affine3d>& rest) {
  const int parent = nodes.parents[finger.node];
  Eigen::Matrix3d above = Eigen::Matrix3d::Identity();
  if (parent >= 0) above = rest[parent].linear();
  const double sense = above.determinant() < 0 ? -1 : 1;  // of a mirrored rig
  const Eigen::Vector3d axis = above.inverse() * finger.axis;
  return Eigen::AngleAxisd(sense * angle, axis.normalized()) * nodes.rest[finger.node].rotation;
}

/// The node right above all bones of a body; -1 if there is none, as the pelvis is the topmost.
int NodeAbove(const GltfNodes& nodes, const CharacterBody& body) {
  const auto is_below = [&](int node, int above) {
    while (node >= 0 && node != above) node = nodes.parents[node];
    return node >= 0;
  };
  const auto is_above_all = [&](int node) {
    return std::ranges::all_of(body.nodes,
                               [&](int bone) { return bone < 0 || is_below(bone, node); });
  };
  const int pelvis = body.nodes.front();
  for (int node = nodes.parents[pelvis]; node >= 0; node = nodes.parents[node])
    if (is_above_all(node)) return node;
  if (nodes.parents[pelvis] < 0 && is_above_all(pelvis)) return -1;
  throw InvalidArgument("nodes", "none is above all its bones, to carry them over the floor");
}

/// Adds a node above the topmost one of the scenes; returns it.
int AddNodeAbove(int topmost, GltfBuilder* gltf) {
  ordered_json& nodes = gltf->List("nodes");
  const size_t above = nodes.size();
  nodes.push_back({{"name", "root"}, {"children", {topmost}}});
  for (ordered_json& scene : gltf->List("scenes")) {
    for (ordered_json& top : scene["nodes"])
      if (top == topmost) top = above;
  }
  return static_cast<int>(above);
}

/// The track of a node that carries its descendants over the floor. `node` -1: a node to be added.
GltfTrack CarriedOver(const std::vector<GroundFrame>& way, int node, const GltfNodes& nodes,
                      const std::vector<Eigen::Affine3d>& rest) {
  GltfTrack track;
  track.node = node;
  const int parent = node < 0 ? -1 : nodes.parents[node];
  const Eigen::Affine3d above = parent < 0 ? Eigen::Affine3d::Identity() : rest[parent];
  const Eigen::Affine3d at_rest = node < 0 ? Eigen::Affine3d::Identity() : rest[node];
  const GltfPlacement local = node < 0 ? GltfPlacement() : nodes.rest[node];
  const Eigen::Vector3d unscaled = local.scale.cwiseInverse();
  for (const GroundFrame& place : way) {
    const Eigen::Affine3d moved = above.inverse() * Eigen::Translation3d(place.origin) *
                                  Eigen::AngleAxisd(place.heading, Eigen::Vector3d::UnitY()) *
                                  at_rest;
    const Eigen::Matrix3d turned = moved.linear() * unscaled.asDiagonal();
    track.AddTurn(Eigen::Quaterniond(Eigen::Affine3d(turned).rotation()));
    track.AddPlace(moved.translation());
  }
  return track;
}

// Replaces a node's matrix by its parts, because animated nodes must not have a matrix.
void StateParts(ordered_json& node, const GltfPlacement& rest) {
  if (!node.is_object() || node.erase("matrix") == 0) return;
  const auto list = [](const auto& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  node["translation"] = list(rest.translation);
  node["rotation"] = list(rest.rotation.coeffs());
  node["scale"] = list(rest.scale);
}

}  // namespace

void CharacterFile::WriteDance(const std::filesystem::path& out, const CharacterBody& body,
                               const Motion& danced, const std::vector<CurledBone>& fingers,
                               RootMotion root) const {
  RequireWritable(body.skeleton, danced);
  Motion motion = root == RootMotion::kInPlace ? InPlace(danced) : danced;
  std::string bytes;
  try {
    DrivenNodes driven(nodes_, body);
    if (static_cast<double>(driven.size() * motion.frames.size()) > kMaxPlaces) {
      throw InvalidArgument("nodes", std::to_string(driven.size()) + " above its bones in " +
                                         std::to_string(motion.frames.size()) +
                                         " frames, at most " + Rounded(kMaxPlaces) +
                                         " places are written");
    }
    SplitMotion split;
    if (root == RootMotion::kRoot) {
      split = SplitAtRoot(danced);
      motion = split.body;
    }
    std::vector<GltfTrack> tracks;
    for (const int node : body.nodes) tracks.emplace_back().node = node;
    for (const choreo::Pose& pose : motion.frames) {
      driven.Pose(pose);
      for (size_t joint = 0; joint < tracks.size(); ++joint) {
        if (tracks[joint].node < 0) continue;
        tracks[joint].AddTurn(driven.local(joint).rotation);
        if (driven.moves(joint)) tracks[joint].AddPlace(driven.local(joint).translation);
      }
    }
    const std::vector<Eigen::Affine3d> rest = nodes_.PlaceAtRest();
    const int above = root == RootMotion::kRoot ? NodeAbove(nodes_, body) : -1;
    const size_t carried = tracks.size();
    if (root == RootMotion::kRoot) tracks.push_back(CarriedOver(split.way, above, nodes_, rest));
    for (const CurledBone& finger : fingers) {
      GltfTrack& track = tracks.emplace_back();
      track.node = finger.node;
      for (const double angle : finger.angles) track.AddTurn(Curled(finger, angle, nodes_, rest));
    }
    const GlbChunks chunks = SplitGlb(bytes_);
    GltfBuilder added(ordered_json::parse(chunks.json), chunks.binary);
    for (const GltfTrack& track : tracks) {
      if (track.node >= 0) StateParts(added.List("nodes")[track.node], nodes_.rest[track.node]);
    }
    if (root == RootMotion::kRoot && above < 0)
      tracks[carried].node = AddNodeAbove(body.nodes.front(), &added);
    added.AddDance(motion.fps, motion.frames.size(), tracks);
    bytes = added.Join(chunks.others);
  } catch (const Error& error) {
    throw Error(error.code(), path_.string(), error.what());
  }
  WriteFile(out, bytes);
}

}  // namespace choreo
