#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <set>
#include <utility>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/formats/character_contents.h"
#include "model/formats/character_file.h"
#include "model/formats/gltf_nodes.h"
#include "model/formats/own_arrays.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

using nlohmann::ordered_json;

constexpr double kFlattest = 1e-6;  // of a node's largest scale: below it is zero
constexpr int kFloats = 5126;       // glTF's number for them

/// The nodes that a body moves, through a dance.
class DrivenNodes {
 public:
  DrivenNodes(const GltfNodes& nodes, const CharacterBody& body)
      : nodes_(nodes), body_(body), local_(nodes.rest()), joint_of_(nodes.names().size(), -1) {
    world_ = nodes.Place(nodes.rest());
    for (size_t joint = 0; joint < body.nodes.size(); ++joint) {
      if (body.nodes[joint] >= 0)
        joint_of_[static_cast<size_t>(body.nodes[joint])] = static_cast<int>(joint);
    }
    // What stands below the pelvis or beside it, as far as there are bones.
    std::set<size_t> needed;
    for (const int node : body.nodes) {
      for (int above = node; above >= 0; above = nodes.parent(static_cast<size_t>(above))) {
        if (!needed.insert(static_cast<size_t>(above)).second) break;
      }
    }
    for (const size_t node : nodes.order()) {
      if (!needed.contains(node)) continue;
      order_.push_back(node);
      if (joint_of_[node] >= 0) RequireVolume(node);
    }
    for (size_t joint = 0; joint < body.nodes.size(); ++joint) {
      rest_.push_back(
          body.nodes[joint] < 0
              ? Eigen::Matrix3d::Identity()
              : Eigen::Matrix3d(world_[static_cast<size_t>(body.nodes[joint])].linear()));
      moves_.push_back(body.nodes[joint] >= 0 && Moves(joint));
    }
  }

  size_t size() const { return order_.size(); }
  /// Whether a joint's node changes its place in its parent.
  bool moves(size_t joint) const { return moves_[joint]; }
  const GltfPlacement& local(size_t joint) const {
    return local_[static_cast<size_t>(body_.nodes[joint])];
  }

  void Pose(const choreo::Pose& pose) {
    ForwardKinematics(body_.skeleton, pose, placement_);
    for (const size_t node : order_) {
      const int parent = nodes_.parent(node);
      const Eigen::Affine3d above =
          parent < 0 ? Eigen::Affine3d::Identity() : world_[static_cast<size_t>(parent)];
      GltfPlacement& local = local_[node];
      if (joint_of_[node] >= 0) {
        const auto joint = static_cast<size_t>(joint_of_[node]);
        const Eigen::Matrix3d turned =
            placement_.rotations[joint] * body_.turns[joint] * rest_[joint];
        const Eigen::Matrix3d inside =
            above.linear().inverse() * turned * local.scale.cwiseInverse().asDiagonal();
        // Under scales that differ by axis the nearest turn.
        local.rotation = Eigen::Quaterniond(Eigen::Affine3d(inside).rotation());
        if (moves_[joint])
          local.translation =
              above.inverse() *
              Eigen::Vector3d(placement_.positions.col(static_cast<Eigen::Index>(joint)));
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

  // The pelvis does, and a bone that hangs elsewhere than on the bone above it.
  bool Moves(size_t joint) const {
    const int above = body_.skeleton.parents[joint];
    if (above < 0) return true;
    int node = nodes_.parent(static_cast<size_t>(body_.nodes[joint]));
    while (node >= 0 && joint_of_[static_cast<size_t>(node)] < 0)
      node = nodes_.parent(static_cast<size_t>(node));
    return node < 0 || joint_of_[static_cast<size_t>(node)] != above;
  }

  const GltfNodes& nodes_;
  const CharacterBody& body_;
  std::vector<GltfPlacement> local_;
  std::vector<Eigen::Affine3d> world_;
  std::vector<int> joint_of_;          // [nodes] -1: none
  std::vector<size_t> order_;          // parents first
  std::vector<Eigen::Matrix3d> rest_;  // [joints] of the nodes, in the world
  std::vector<bool> moves_;            // [joints]
  JointPlacement placement_;
};

/// A file's JSON and data, to which accessors are added.
class Additions {
 public:
  Additions(ordered_json document, std::string_view binary)
      : document_(std::move(document)), binary_(binary) {
    ordered_json& buffers = List("buffers");
    if (buffers.empty()) buffers.push_back({{"byteLength", 0}});
  }

  ordered_json& List(const char* name) {
    ordered_json& list = document_[name];
    if (list.is_null()) list = ordered_json::array();
    if (!list.is_array()) throw InvalidArgument(name, "is no list");
    return list;
  }

  /// Floats as an accessor of this type.
  size_t Add(const std::vector<float>& values, const char* type, size_t width,
             bool bounds = false) {
    binary_.resize((binary_.size() + 3) / 4 * 4);
    ordered_json& views = List("bufferViews");
    views.push_back({{"buffer", 0},
                     {"byteOffset", binary_.size()},
                     {"byteLength", values.size() * sizeof(float)}});
    binary_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    ordered_json accessor = {{"bufferView", views.size() - 1},
                             {"componentType", kFloats},
                             {"count", values.size() / width},
                             {"type", type}};
    if (bounds) {
      accessor["min"] = {values.front()};
      accessor["max"] = {values.back()};
    }
    ordered_json& accessors = List("accessors");
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }

  std::string Join(std::string_view others) {
    document_["buffers"][0]["byteLength"] = binary_.size();
    return JoinGlb({.json = document_.dump(), .binary = binary_, .others = others});
  }

  ordered_json& document() { return document_; }

 private:
  ordered_json document_;
  std::string binary_;
};

// A node that is animated has no matrix.
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
                               const Motion& motion) const {
  const auto named = [&](const Error& error) {
    return Error(error.code(), contents_->path.string(), error.what());
  };
  RequireWritable(body.skeleton, motion);
  std::string bytes;
  try {
    DrivenNodes driven(contents_->nodes, body);
    const auto frames = static_cast<double>(motion.frames.size());
    if (static_cast<double>(driven.size()) * frames > kMaxPlaces) {
      throw InvalidArgument("nodes", std::to_string(driven.size()) + " above its bones in " +
                                         std::to_string(motion.frames.size()) +
                                         " frames, at most 30000000 places are written");
    }
    const size_t joints = body.nodes.size();
    std::vector<float> times;
    std::vector<std::vector<float>> turns(joints), places(joints);
    for (const choreo::Pose& pose : motion.frames) {
      times.push_back(static_cast<float>(static_cast<double>(times.size()) / motion.fps));
      driven.Pose(pose);
      for (size_t joint = 0; joint < joints; ++joint) {
        if (body.nodes[joint] < 0) continue;
        const GltfPlacement& local = driven.local(joint);
        AppendTurn(local.rotation, &turns[joint]);
        const Eigen::Vector3f place = local.translation.cast<float>();
        if (driven.moves(joint))
          places[joint].insert(places[joint].end(), place.begin(), place.end());
      }
    }

    Additions added(contents_->document, contents_->chunks.binary);
    const size_t input = added.Add(times, "SCALAR", 1, true);
    ordered_json animation = {{"name", "dance"},
                              {"channels", ordered_json::array()},
                              {"samplers", ordered_json::array()},
                              {"extras", {{"fps", motion.fps}}}};
    const auto channel = [&](int node, const char* path, size_t output) {
      animation["samplers"].push_back(
          {{"input", input}, {"interpolation", "LINEAR"}, {"output", output}});
      animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                       {"target", {{"node", node}, {"path", path}}}});
    };
    for (size_t joint = 0; joint < joints; ++joint) {
      const int node = body.nodes[joint];
      if (node < 0) continue;
      StateParts(added.List("nodes")[static_cast<size_t>(node)],
                 contents_->nodes.rest()[static_cast<size_t>(node)]);
      channel(node, "rotation", added.Add(turns[joint], "VEC4", 4));
      if (driven.moves(joint)) channel(node, "translation", added.Add(places[joint], "VEC3", 3));
    }
    ordered_json& animations = added.List("animations");
    animations.insert(animations.begin(), std::move(animation));
    bytes = added.Join(contents_->chunks.others);
  } catch (const Error& error) {
    throw named(error);
  }
  WriteFile(out, bytes);
}

}  // namespace choreo
