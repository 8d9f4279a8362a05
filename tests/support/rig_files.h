#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/fit/bones/human_bones.h"
#include "model/formats/bvh/bvh.h"
#include "model/motion/rotation.h"

/// Rigs for tests, as other programs export them: a body in centimetres that at rest stands with
/// arms held out and faces +Z.
namespace choreo::testing_support {

struct RigJoint {
  std::string bone;  ///< a name of HumanBones
  std::string parent;
  Eigen::Vector3d offset;  ///< at rest, world axes
};

inline const std::vector<RigJoint>& RigBody() {
  static const std::vector<RigJoint> body = [] {
    std::vector<RigJoint> joints = {
        {"pelvis", "", {0, 92, 0}},       {"spine1", "pelvis", {0, 10, 0}},
        {"spine2", "spine1", {0, 14, 0}}, {"spine3", "spine2", {0, 14, 0}},
        {"neck", "spine3", {0, 16, 0}},   {"head", "neck", {0, 10, 2}}};
    for (const std::string side : {"left_", "right_"}) {
      const double out = side == "left_" ? 1 : -1;
      joints.push_back({side + "hip", "pelvis", {9 * out, -4, 0}});
      joints.push_back({side + "knee", side + "hip", {0, -41, 0}});
      joints.push_back({side + "ankle", side + "knee", {0, -40, 0}});
      joints.push_back({side + "foot", side + "ankle", {0, -6, 13}});
      joints.push_back({side + "collar", "spine3", {4 * out, 10, 0}});
      joints.push_back({side + "shoulder", side + "collar", {13 * out, 0, 0}});
      joints.push_back({side + "elbow", side + "shoulder", {28 * out, 0, 0}});
      joints.push_back({side + "wrist", side + "elbow", {25 * out, 0, 0}});
    }
    return joints;
  }();
  return body;
}

inline int RigIndex(const std::string& bone) {
  for (size_t i = 0; i < RigBody().size(); ++i)
    if (RigBody()[i].bone == bone) return static_cast<int>(i);
  return -1;
}

/// A bone's rotation relative to its parent in a frame, in world axes at rest.
using RigTurn = std::function<Eigen::Matrix3d(const std::string& bone, int frame)>;

inline Eigen::Matrix3d About(double x, double y, double z, double degrees) {
  return Eigen::AngleAxisd(degrees / kDegrees, Eigen::Vector3d(x, y, z).normalized())
      .toRotationMatrix();
}

/// A walk: arms hang, legs step, the trunk turns a little.
inline Eigen::Matrix3d Walk(const std::string& bone, int frame) {
  const double swing = std::sin(frame * 0.3);
  const double side = bone.starts_with("left_") ? 1 : -1;
  if (bone == "pelvis") return About(0, 1, 0, 10 * swing);
  if (bone == "spine2") return About(0, 1, 0, -15 * swing);
  if (bone.ends_with("_hip")) return About(1, 0, 0, -30 * side * swing);
  if (bone.ends_with("_knee")) return About(1, 0, 0, 25 + 15 * side * swing);
  if (bone.ends_with("_shoulder")) return About(0, 0, 1, -70 * side) * About(0, 1, 0, 20 * swing);
  if (bone.ends_with("_elbow")) return About(0, 1, 0, -30 * side);
  return Eigen::Matrix3d::Identity();
}

/// All bones of RigBody in a frame: positions in centimetres, rotations since rest.
struct RigState {
  Eigen::Matrix3Xd places;
  std::vector<Eigen::Matrix3d> turns;
};
inline RigState MoveRig(const RigTurn& turn, int frame) {
  RigState state{Eigen::Matrix3Xd(3, RigBody().size()), {}};
  for (const RigJoint& joint : RigBody()) {
    const auto i = static_cast<Eigen::Index>(state.turns.size());
    const Eigen::Matrix3d local = turn(joint.bone, frame);
    if (joint.parent.empty()) {
      state.places.col(i) = joint.offset + Eigen::Vector3d(frame, 0, 0);
      state.turns.push_back(local);
    } else {
      const int parent = RigIndex(joint.parent);
      state.places.col(i) = state.places.col(parent) + state.turns[parent] * joint.offset;
      state.turns.emplace_back(state.turns[parent] * local);
    }
  }
  return state;
}

using RigNames = std::function<std::string(const std::string& bone)>;

/// The names of one of the known rigs; bones that it lacks keep ours.
inline RigNames NamesOf(std::string_view rig) {
  return [rig](const std::string& bone) {
    const std::string name = NameInRig(rig, bone);
    return name.empty() ? "x_" + bone : name;
  };
}

struct BvhRig {
  RigNames names = NamesOf(kHumanIkRig);
  RigTurn turn = Walk;
  int frames = 30;
  Eigen::Matrix3d world = Eigen::Matrix3d::Identity();  ///< rotation of the whole file
  /// Rotation of each bone (and its offset) at rest: the file's zero pose is not a body.
  std::function<Eigen::Matrix3d(const std::string& bone)> zero = [](const std::string&) {
    return Eigen::Matrix3d::Identity();
  };
};

/// Makes a BVH as other tools write it: ZXY angles, six channels at the root. Rest frames are the
/// file's axes rotated by `zero`, and offsets are in these frames.
inline BvhFile MakeBvh(const BvhRig& rig) {
  BvhFile file;
  std::map<std::string, int> at;
  std::vector<std::string> bones;
  const std::function<void(const std::string&)> add = [&](const std::string& bone) {
    const RigJoint& joint = RigBody()[static_cast<size_t>(RigIndex(bone))];
    BvhJoint& added = file.joints.emplace_back();
    added.name = rig.names(bone);
    added.parent = joint.parent.empty() ? -1 : at.at(joint.parent);
    const Eigen::Matrix3d above =
        joint.parent.empty() ? rig.world : Eigen::Matrix3d(rig.zero(joint.parent) * rig.world);
    added.offset = above * joint.offset;
    if (joint.parent.empty())
      added.channels = {BvhChannel::kXPosition, BvhChannel::kYPosition, BvhChannel::kZPosition};
    for (const BvhChannel channel :
         {BvhChannel::kZRotation, BvhChannel::kXRotation, BvhChannel::kYRotation})
      added.channels.push_back(channel);
    at[bone] = static_cast<int>(file.joints.size()) - 1;
    bones.push_back(bone);
    bool leaf = true;
    for (const RigJoint& child : RigBody()) {
      if (child.parent == bone) add(child.bone), leaf = false;
    }
    if (!leaf) return;
    BvhJoint& end = file.joints.emplace_back();
    end.name = rig.names(bone) + "_end";
    end.parent = at[bone];
    end.offset = rig.zero(bone) * rig.world * joint.offset / 2;
    end.end_site = true;
  };
  add("pelvis");
  file.values.resize(3 + 3 * std::ssize(bones), rig.frames);
  for (int frame = 0; frame < rig.frames; ++frame) {
    auto values = file.values.col(frame);
    const RigState state = MoveRig(rig.turn, frame);
    values.head<3>() = rig.world * state.places.col(0);
    Eigen::Index row = 3;
    for (const std::string& bone : bones) {
      const auto turned = [&](const std::string& name) -> Eigen::Matrix3d {
        if (name.empty()) return Eigen::Matrix3d::Identity();
        return rig.world * state.turns[static_cast<size_t>(RigIndex(name))] *
               rig.world.transpose() * rig.zero(name).transpose();
      };
      const std::string& parent = RigBody()[static_cast<size_t>(RigIndex(bone))].parent;
      const Eigen::Matrix3d r = turned(parent).transpose() * turned(bone);
      const double sine = std::clamp(r(2, 1), -1.0, 1.0);
      // A quarter turn about x makes the other two axes coincide.
      const bool locked = std::abs(sine) > 1 - 1e-9;
      values[row++] =
          (locked ? std::atan2(r(1, 0), r(0, 0)) : std::atan2(-r(0, 1), r(1, 1))) * kDegrees;
      values[row++] = std::asin(sine) * kDegrees;
      values[row++] = locked ? 0 : std::atan2(-r(2, 0), r(2, 2)) * kDegrees;
    }
  }
  return file;
}

/// Builds a glTF file with any number of rigs.
class GlbRigs {
 public:
  using Json = nlohmann::json;

  Json document = {{"asset", {{"version", "2.0"}}},
                   {"nodes", Json::array()},
                   {"accessors", Json::array()},
                   {"bufferViews", Json::array()},
                   {"buffers", Json::array({Json{{"byteLength", 0}}})}};
  std::string binary;

  size_t AddFloats(const std::vector<float>& values, const std::string& type) {
    const size_t width = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", 4 * values.size()}});
    binary.append(reinterpret_cast<const char*>(values.data()), 4 * values.size());
    document["buffers"][0]["byteLength"] = binary.size();
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", 5126},
                                     {"count", values.size() / width},
                                     {"type", type}});
    return document["accessors"].size() - 1;
  }

  int AddNode(const Json& node) {
    document["nodes"].push_back(node);
    return static_cast<int>(document["nodes"].size()) - 1;
  }

  /// Adds RigBody in metres, displaced by `aside`. Returns the first node's index; the others
  /// follow in RigBody's order.
  int AddBody(const RigNames& names, double aside = 0) {
    const auto first = static_cast<int>(document["nodes"].size());
    for (const RigJoint& joint : RigBody()) {
      Eigen::Vector3d place = joint.offset / 100;
      if (joint.parent.empty()) place.x() += aside;
      const int node = AddNode(
          {{"name", names(joint.bone)}, {"translation", {place.x(), place.y(), place.z()}}});
      if (!joint.parent.empty())
        document["nodes"][first + RigIndex(joint.parent)]["children"].push_back(node);
    }
    return first;
  }

  void AddSkin(int first) {
    Json joints = Json::array();
    std::vector<float> inverse;
    const RigState rest = MoveRig([](const auto&, int) { return Eigen::Matrix3d::Identity(); }, 0);
    for (size_t i = 0; i < RigBody().size(); ++i) {
      joints.push_back(first + static_cast<int>(i));
      Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
      matrix.topRightCorner<3, 1>() =
          -rest.places.col(static_cast<Eigen::Index>(i)).cast<float>() / 100;
      inverse.insert(inverse.end(), matrix.data(), matrix.data() + 16);
    }
    document["skins"].push_back(
        {{"joints", joints}, {"inverseBindMatrices", AddFloats(inverse, "MAT4")}});
  }

  /// Rotations of all bones, and positions of the pelvis.
  void AddAnimation(const std::string& name, int first, const RigTurn& turn, int frames) {
    std::vector<float> times, places;
    for (int frame = 0; frame < frames; ++frame) {
      times.push_back(static_cast<float>(frame / 30.0));
      const RigState state = MoveRig(turn, frame);
      for (const double value : state.places.col(0))
        places.push_back(static_cast<float>(value / 100));
    }
    const size_t input = AddFloats(times, "SCALAR");
    Json animation = {{"name", name}, {"channels", Json::array()}, {"samplers", Json::array()}};
    const auto channel = [&](int node, const char* path, size_t output) {
      animation["samplers"].push_back({{"input", input}, {"output", output}});
      animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                       {"target", {{"node", node}, {"path", path}}}});
    };
    for (size_t i = 0; i < RigBody().size(); ++i) {
      std::vector<float> turns;
      for (int frame = 0; frame < frames; ++frame) {
        const Eigen::Quaterniond q(turn(RigBody()[i].bone, frame));
        for (const double value : q.coeffs()) turns.push_back(static_cast<float>(value));
      }
      channel(first + static_cast<int>(i), "rotation", AddFloats(turns, "VEC4"));
    }
    channel(first, "translation", AddFloats(places, "VEC3"));
    document["animations"].push_back(animation);
  }

  std::string Bytes() const {
    std::string json = document.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    const auto word = [&](size_t value) {
      const auto narrow = static_cast<uint32_t>(value);
      bytes.append(reinterpret_cast<const char*>(&narrow), 4);
    };
    word(2), word(28 + json.size() + binary.size()), word(json.size());
    bytes += "JSON" + json;
    word(binary.size());
    return bytes + std::string("BIN\0", 4) + binary;
  }
};

}  // namespace choreo::testing_support
