#include "tests/support/character_rigs.h"

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "model/fit/bones/human_bones.h"
#include "model/formats/gltf/gltf.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/support/glb_parts.h"

namespace choreo::testing_support {
namespace {

using nlohmann::json;

constexpr double kDegree = std::numbers::pi / 180;

json List(const auto& values) { return std::vector<double>(values.begin(), values.end()); }

Pose AtRest(const CharacterRig& rig) {
  Pose pose = RestPose(rig.body);
  pose.rotations.col(0) << 0, rig.facing * kDegree, 0;
  pose.rotations.col(rig.body.left_shoulder) << 0, 0, -rig.arms_down * kDegree;
  pose.rotations.col(rig.body.right_shoulder) << 0, 0, rig.arms_down * kDegree;
  return pose;
}

std::vector<Eigen::Quaterniond> Rolls(const CharacterRig& rig) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-3, 3);
  std::vector<Eigen::Quaterniond> rolls;
  for (int joint = 0; joint < rig.body.joints(); ++joint) {
    const Eigen::Vector3d turn(angle(random), angle(random), angle(random));
    rolls.push_back(rig.rolled ? QuaternionFromExp(turn) : Eigen::Quaterniond::Identity());
  }
  return rolls;
}

std::string NodeName(const CharacterRig& rig, int joint) {
  if (rig.rig.empty()) return "bone." + std::to_string(joint * 7 % 24);
  return rig.prefix + NameInRig(rig.rig, rig.body.joint_names[static_cast<size_t>(joint)]);
}

// Removes the animation, whose accessors are the last ones.
void RemoveAnimation(Glb* glb) {
  json& document = glb->document;
  const size_t first = document["animations"][0]["samplers"][0]["input"].get<size_t>();
  json& accessors = document["accessors"];
  json& views = document["bufferViews"];
  const size_t view = accessors[first]["bufferView"].get<size_t>();
  glb->binary.resize(views[view]["byteOffset"].get<size_t>());
  document["buffers"][0]["byteLength"] = glb->binary.size();
  accessors.erase(accessors.begin() + static_cast<std::ptrdiff_t>(first), accessors.end());
  views.erase(views.begin() + static_cast<std::ptrdiff_t>(view), views.end());
  document.erase("animations");
}

}  // namespace

void WriteCharacter(const std::filesystem::path& path, const CharacterRig& rig) {
  const Skeleton& body = rig.body;
  WriteGlb(path, body, {.fps = 30, .frames = {RestPose(body)}});
  Glb glb(path);
  RemoveAnimation(&glb);
  const std::vector<Eigen::Quaterniond> rolls = Rolls(rig);
  const JointPlacement rest = ForwardKinematics(body, AtRest(rig));
  const Eigen::Quaterniond armature = rig.armature_scale == 1
                                          ? Eigen::Quaterniond::Identity()
                                          : QuaternionFromExp({-std::numbers::pi / 2, 0, 0});
  // World transform of a joint's node: turned at rest, rolled, scaled with the armature.
  const auto frame = [&](int joint) {
    const auto i = static_cast<size_t>(joint);
    return Eigen::Affine3d(Eigen::Translation3d(rest.positions.col(joint)) *
                           (Eigen::Quaterniond(rest.rotations[i]) * rolls[i]) *
                           Eigen::Scaling(rig.armature_scale));
  };
  const Eigen::Affine3d above(armature * Eigen::Scaling(rig.armature_scale));
  for (int joint = 0; joint < body.joints(); ++joint) {
    json& node = glb.document["nodes"][static_cast<size_t>(joint)];
    const int parent = body.parents[static_cast<size_t>(joint)];
    const Eigen::Affine3d local = (parent < 0 ? above : frame(parent)).inverse() * frame(joint);
    node["name"] = NodeName(rig, joint);
    node["translation"] = List(Eigen::Vector3d(local.translation()));
    node["rotation"] = List(Eigen::Quaterniond(local.rotation()).coeffs());
  }
  // The mesh is bound with arms held out, in the rolled frames.
  const json& inverse =
      glb.document["accessors"][glb.document["skins"][0]["inverseBindMatrices"].get<size_t>()];
  char* data =
      glb.binary.data() +
      glb.document["bufferViews"][inverse["bufferView"].get<size_t>()]["byteOffset"].get<size_t>();
  for (int joint = 0; joint < body.joints(); ++joint, data += sizeof(Eigen::Matrix4f)) {
    Eigen::Matrix4f bind;
    std::memcpy(bind.data(), data, sizeof(bind));
    const Eigen::Affine3d unrolled(Eigen::Scaling(1 / rig.armature_scale) *
                                   rolls[static_cast<size_t>(joint)].inverse());
    bind = (unrolled.matrix() * bind.cast<double>()).cast<float>();
    std::memcpy(data, bind.data(), sizeof(bind));
  }
  json& nodes = glb.document["nodes"];
  nodes.push_back({{"name", "Armature"},
                   {"children", {0}},
                   {"rotation", List(armature.coeffs())},
                   {"scale", {rig.armature_scale, rig.armature_scale, rig.armature_scale}}});
  glb.document["scenes"][0]["nodes"][0] = nodes.size() - 1;
  glb.Write(path);
}

}  // namespace choreo::testing_support
