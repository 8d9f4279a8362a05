#include <cmath>

#include "model/body/skin.h"
#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/fit/human_bones.h"
#include "model/formats/gltf.h"
#include "model/formats/gltf_builder.h"
#include "model/formats/own_arrays.h"
#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

using Json = GltfBuilder::Json;

constexpr double kRoughness = 0.75;
constexpr int kVertices = 34962, kTriangles = 34963, kTriangleMode = 4;  // glTF's numbers

// A colour as glTF wants it: linear light.
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

// Joint i becomes node i.
void AddJoints(const Skeleton& skeleton, GltfBuilder* gltf) {
  Json& nodes = gltf->List("nodes");
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    Eigen::Vector3d rest = skeleton.offsets.col(joint);
    if (joint == 0) rest.y() = skeleton.pelvis_height;
    nodes.push_back(
        {{"name", skeleton.joint_names[joint]}, {"translation", {rest.x(), rest.y(), rest.z()}}});
    if (joint > 0) nodes[skeleton.parents[joint]]["children"].push_back(joint);
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

// The doll, bound to the joints.
void AddBody(const Skeleton& skeleton, GltfBuilder* gltf) {
  Json primitives = Json::array();
  for (const SkinPatch& patch : MakeSkin(skeleton)) primitives.push_back(AddPatch(patch, gltf));
  gltf->List("meshes").push_back({{"name", "body"}, {"primitives", primitives}});
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  std::vector<float> inverse_bind;
  Json joints = Json::array();
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
    matrix.topRightCorner<3, 1>() = -rest.col(joint).cast<float>();
    inverse_bind.insert(inverse_bind.end(), matrix.data(), matrix.data() + matrix.size());
    joints.push_back(joint);
  }
  const size_t matrices = gltf->Add<float>(inverse_bind, "MAT4");
  gltf->List("skins").push_back({{"name", skeleton.name},
                                 {"skeleton", 0},
                                 {"joints", joints},
                                 {"inverseBindMatrices", matrices}});
  gltf->List("nodes").push_back({{"name", "body"}, {"mesh", 0}, {"skin", 0}});
  // The skinned mesh stands beside its skeleton: what is above it would not move it anyway.
  gltf->List("scenes").push_back({{"name", "dance"}, {"nodes", {0, skeleton.joints()}}});
}

void AddMotion(const Skeleton& skeleton, const Motion& motion, GltfBuilder* gltf) {
  std::vector<GltfTrack> tracks(static_cast<size_t>(skeleton.joints()));
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    GltfTrack& track = tracks[joint];
    track.node = joint;
    for (const Pose& pose : motion.frames) {
      track.AddTurn(QuaternionFromExp(pose.rotations.col(joint)));
      if (joint == 0) track.AddPlace(pose.root_position);
    }
  }
  gltf->AddDance(motion.fps, motion.frames.size(), tracks);
}

Json NewDocument() {
  return {{"asset", {{"version", "2.0"}, {"generator", "choreo"}}}, {"scene", 0}};
}

}  // namespace

void WriteGlb(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion) {
  RequireWritable(skeleton, motion);
  GltfBuilder gltf(NewDocument(), {});
  AddJoints(skeleton, &gltf);
  AddBody(skeleton, &gltf);
  AddMotion(skeleton, motion, &gltf);
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
    // SMPL's hands are no bone of VRM's: palms, which go along.
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
  AddMotion(skeleton, motion, &gltf);
  WriteFile(path, gltf.Join());
}

}  // namespace choreo
