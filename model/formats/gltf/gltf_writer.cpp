#include <cmath>

#include "model/body/skin.h"
#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/fit/bones/human_bones.h"
#include "model/formats/arrays/own_arrays.h"
#include "model/formats/gltf/gltf.h"
#include "model/formats/gltf/gltf_builder.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

using Json = GltfBuilder::Json;

constexpr double kRoughness = 0.75;
constexpr int kVertices = 34962, kTriangles = 34963, kTriangleMode = 4;  // glTF's numbers

// A colour in linear light, as in glTF.
double Linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

const char* MaterialName(const Colour& colour) {
  if (colour == kLeftColour) return "left";
  if (colour == kRightColour) return "right";
  if (colour == kSkinColour) return "skin";
  if (colour == kHairColour) return "hair";
  return "trunk";
}

Json Material(const Colour& colour) {
  return {{"name", MaterialName(colour)},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {Linear(colour.r), Linear(colour.g), Linear(colour.b), 1.0}},
            {"metallicFactor", 0.0},
            {"roughnessFactor", kRoughness}}}};
}

// Joint i becomes node first + i.
void AddJoints(const Skeleton& skeleton, GltfBuilder* gltf, const std::string& prefix = "") {
  Json& nodes = gltf->List("nodes");
  const size_t first = nodes.size();
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    Eigen::Vector3d rest = skeleton.offsets.col(joint);
    if (joint == 0) rest.y() = skeleton.pelvis_height;
    nodes.push_back({{"name", prefix + skeleton.joint_names[joint]},
                     {"translation", {rest.x(), rest.y(), rest.z()}}});
    if (joint > 0)
      nodes[first + static_cast<size_t>(skeleton.parents[joint])]["children"].push_back(first +
                                                                                        joint);
  }
}

Json AddPatch(const SkinPatch& patch, GltfBuilder* gltf) {
  std::vector<uint16_t> joints;
  std::vector<uint8_t> weights;
  for (const uint16_t joint : patch.joints) {
    joints.insert(joints.end(), {joint, 0, 0, 0});
    weights.insert(weights.end(), {255, 0, 0, 0});
  }
  const auto vectors = [&](const std::vector<Eigen::Vector3f>& values, bool bounds) {
    return gltf->Add(std::span(values.front().data(), 3 * values.size()), "VEC3", bounds,
                     kVertices);
  };
  Json attributes;
  attributes["POSITION"] = vectors(patch.positions, true);
  attributes["NORMAL"] = vectors(patch.normals, false);
  attributes["JOINTS_0"] = gltf->Add<uint16_t>(joints, "VEC4", false, kVertices);
  attributes["WEIGHTS_0"] = gltf->Add<uint8_t>(weights, "VEC4", false, kVertices);
  gltf->List("accessors").back()["normalized"] = true;
  const size_t indices =
      gltf->Add(std::span(patch.triangles.front().data(), 3 * patch.triangles.size()), "SCALAR",
                false, kTriangles);
  Json& materials = gltf->List("materials");
  materials.push_back(Material(patch.colour));
  return {{"attributes", attributes},
          {"indices", indices},
          {"material", materials.size() - 1},
          {"mode", kTriangleMode}};
}

// Adds the doll's mesh and the inverse rest matrices of the skin's joints, and of a root on the
// floor after them; returns their accessor.
size_t AddBody(const Skeleton& skeleton, bool has_root, GltfBuilder* gltf) {
  Json primitives = Json::array();
  for (const SkinPatch& patch : MakeSkin(skeleton)) primitives.push_back(AddPatch(patch, gltf));
  gltf->List("meshes").push_back({{"name", "body"}, {"primitives", primitives}});
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  std::vector<float> inverse_bind;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
    matrix.topRightCorner<3, 1>() = -rest.col(joint).cast<float>();
    inverse_bind.insert(inverse_bind.end(), matrix.data(), matrix.data() + matrix.size());
  }
  const Eigen::Matrix4f root = Eigen::Matrix4f::Identity();
  if (has_root) inverse_bind.insert(inverse_bind.end(), root.data(), root.data() + root.size());
  return gltf->Add<float>(inverse_bind, "MAT4");
}

// Adds a body bound to its joints, which are the nodes from `first` on, and its root on the floor,
// if it has one. Returns the nodes of the scene.
Json AddSkin(const Skeleton& skeleton, size_t matrices, size_t first, bool has_root,
             const std::string& prefix, GltfBuilder* gltf) {
  Json joints = Json::array();
  for (int joint = 0; joint < skeleton.joints(); ++joint) joints.push_back(first + joint);
  if (has_root) {
    Json& nodes = gltf->List("nodes");
    joints.push_back(nodes.size());
    nodes.push_back({{"name", prefix + "root"}, {"children", {first}}});
    first = nodes.size() - 1;
  }
  Json& skins = gltf->List("skins");
  skins.push_back({{"name", prefix + skeleton.name},
                   {"skeleton", first},
                   {"joints", joints},
                   {"inverseBindMatrices", matrices}});
  Json& nodes = gltf->List("nodes");
  nodes.push_back({{"name", prefix + "body"}, {"mesh", 0}, {"skin", skins.size() - 1}});
  // The skinned mesh is a sibling of its skeleton: parents do not move skinned meshes.
  return {first, nodes.size() - 1};
}

void AddTracks(const Skeleton& skeleton, const Motion& motion, int first,
               std::vector<GltfTrack>* tracks) {
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    GltfTrack& track = tracks->emplace_back();
    track.node = first + joint;
    for (const Pose& pose : motion.frames) {
      track.AddTurn(QuaternionFromExp(pose.rotations.col(joint)));
      if (joint == 0) track.AddPlace(pose.root_position);
    }
  }
}

void AddWay(const std::vector<GroundFrame>& way, int node, std::vector<GltfTrack>* tracks) {
  GltfTrack& track = tracks->emplace_back();
  track.node = node;
  for (const GroundFrame& place : way) {
    track.AddTurn(Eigen::Quaterniond(Eigen::AngleAxisd(place.heading, Eigen::Vector3d::UnitY())));
    track.AddPlace(place.origin);
  }
}

Json NewDocument() {
  return {{"asset", {{"version", "2.0"}, {"generator", "choreo"}}}, {"scene", 0}};
}

}  // namespace

void WriteGlb(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
              RootMotion root) {
  WriteGlb(path, skeleton, {{"", motion}}, root);
}

void WriteGlb(const std::filesystem::path& path, const Skeleton& skeleton,
              const std::vector<NamedMotion>& dancers, RootMotion root) {
  if (dancers.empty()) throw InvalidArgument("dancers", "are none");
  const Motion& one = dancers.front().motion;
  for (const auto& [name, motion] : dancers) {
    RequireWritable(skeleton, motion);
    if (motion.fps != one.fps || motion.frames.size() != one.frames.size())
      throw InvalidArgument("dancers", name + " has another rate or length than the first");
  }
  GltfBuilder gltf(NewDocument(), {});
  std::vector<GltfTrack> tracks;
  Json scene = Json::array();
  size_t matrices = 0;
  const bool has_root = root == RootMotion::kRoot;
  for (const auto& [name, motion] : dancers) {
    const std::string prefix = name.empty() ? "" : name + ':';
    const size_t first = gltf.List("nodes").size();
    AddJoints(skeleton, &gltf, prefix);
    if (first == 0) matrices = AddBody(skeleton, has_root, &gltf);
    const Json nodes = AddSkin(skeleton, matrices, first, has_root, prefix, &gltf);
    scene.insert(scene.end(), nodes.begin(), nodes.end());
    const auto pelvis = static_cast<int>(first);
    if (has_root) {
      const SplitMotion split = SplitAtRoot(motion);
      AddTracks(skeleton, split.body, pelvis, &tracks);
      AddWay(split.way, nodes.front(), &tracks);
    } else {
      AddTracks(skeleton, root == RootMotion::kInPlace ? InPlace(motion) : motion, pelvis, &tracks);
    }
  }
  gltf.List("scenes").push_back({{"name", "dance"}, {"nodes", scene}});
  gltf.AddDance(one.fps, one.frames.size(), tracks);
  WriteFile(path, gltf.Join());
}

void WriteVrma(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion) {
  RequireWritable(skeleton, motion);
  if (skeleton.joint_names != Skeleton::Smpl24().joint_names) {
    throw InvalidArgument(
        path.string(), "is written for SMPL's body alone, the motion is of " + skeleton.Describe());
  }
  Json document = NewDocument();
  Json bones;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    // SMPL's hands are palms, which VRM does not have.
    const std::string name = NameInRig(kVrmRig, skeleton.joint_names[joint]);
    if (!name.empty() && !skeleton.joint_names[joint].ends_with("_hand"))
      bones[name] = {{"node", joint}};
  }
  document["extensionsUsed"] = {"VRMC_vrm_animation"};
  document["extensions"]["VRMC_vrm_animation"] = {{"specVersion", "1.0"},
                                                  {"humanoid", {{"humanBones", bones}}}};
  GltfBuilder gltf(document, {});
  AddJoints(skeleton, &gltf);
  gltf.List("scenes").push_back({{"name", "dance"}, {"nodes", {0}}});
  std::vector<GltfTrack> tracks;
  AddTracks(skeleton, motion, 0, &tracks);
  gltf.AddDance(motion.fps, motion.frames.size(), tracks);
  WriteFile(path, gltf.Join());
}

}  // namespace choreo
