#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "model/body/skin.h"
#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/formats/gltf.h"
#include "model/formats/gltf_file.h"
#include "model/formats/own_arrays.h"
#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kRoughness = 0.75;

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

class GlbBuilder {
 public:
  GlbBuilder(const Skeleton& skeleton, const Motion& motion)
      : skeleton_(skeleton), motion_(motion) {
    model_.asset.version = "2.0";
    model_.asset.generator = "choreo";
    model_.buffers.resize(1);
    AddJoints();
    AddBody();
    AddAnimation();
    // The skinned mesh stands beside its skeleton: what is above it would not move it anyway.
    tinygltf::Scene& scene = model_.scenes.emplace_back();
    scene.name = "dance";
    scene.nodes = {0, body_node_};
    model_.defaultScene = 0;
  }

  const tinygltf::Model& model() const { return model_; }

 private:
  // Joint i becomes node i.
  void AddJoints() {
    for (int joint = 0; joint < skeleton_.joints(); ++joint) {
      tinygltf::Node& node = model_.nodes.emplace_back();
      node.name = skeleton_.joint_names[joint];
      Eigen::Vector3d rest = skeleton_.offsets.col(joint);
      if (joint == 0) rest.y() = skeleton_.pelvis_height;
      node.translation = {rest.x(), rest.y(), rest.z()};
      if (joint > 0) model_.nodes[skeleton_.parents[joint]].children.push_back(joint);
    }
  }

  void AddBody() {
    tinygltf::Mesh mesh;
    mesh.name = "body";
    for (const SkinPatch& patch : MakeSkin(skeleton_)) {
      std::vector<float> positions, normals;
      std::vector<uint16_t> joints;
      std::vector<uint8_t> weights;
      std::vector<uint32_t> indices;
      for (size_t i = 0; i < patch.positions.size(); ++i) {
        positions.insert(positions.end(), patch.positions[i].begin(), patch.positions[i].end());
        normals.insert(normals.end(), patch.normals[i].begin(), patch.normals[i].end());
        joints.insert(joints.end(), {patch.joints[i], 0, 0, 0});
        weights.insert(weights.end(), {255, 0, 0, 0});
      }
      for (const auto& triangle : patch.triangles) {
        indices.insert(indices.end(), triangle.begin(), triangle.end());
      }
      constexpr int kVertices = TINYGLTF_TARGET_ARRAY_BUFFER;
      tinygltf::Primitive& primitive = mesh.primitives.emplace_back();
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      primitive.material = AddMaterial(patch.colour);
      primitive.attributes["POSITION"] = Add(positions, TINYGLTF_TYPE_VEC3, kVertices, true);
      primitive.attributes["NORMAL"] = Add(normals, TINYGLTF_TYPE_VEC3, kVertices);
      primitive.attributes["JOINTS_0"] = Add(joints, TINYGLTF_TYPE_VEC4, kVertices);
      primitive.attributes["WEIGHTS_0"] = Add(weights, TINYGLTF_TYPE_VEC4, kVertices);
      model_.accessors[primitive.attributes["WEIGHTS_0"]].normalized = true;
      primitive.indices = Add(indices, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    }
    model_.meshes.push_back(std::move(mesh));
    body_node_ = static_cast<int>(model_.nodes.size());
    tinygltf::Node& node = model_.nodes.emplace_back();
    node.name = "body";
    node.mesh = 0;
    node.skin = 0;
    AddSkin();
  }

  int AddMaterial(const Colour& colour) {
    tinygltf::Material& material = model_.materials.emplace_back();
    material.name = MaterialName(colour);
    tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    pbr.baseColorFactor = {Linear(colour.r), Linear(colour.g), Linear(colour.b), 1};
    pbr.metallicFactor = 0;
    pbr.roughnessFactor = kRoughness;
    return static_cast<int>(model_.materials.size()) - 1;
  }

  void AddSkin() {
    tinygltf::Skin& skin = model_.skins.emplace_back();
    skin.name = skeleton_.name;
    skin.skeleton = 0;
    const Eigen::Matrix3Xd rest = JointPositions(skeleton_, RestPose(skeleton_));
    std::vector<float> inverse_bind;
    for (int joint = 0; joint < skeleton_.joints(); ++joint) {
      skin.joints.push_back(joint);
      Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
      matrix.topRightCorner<3, 1>() = -rest.col(joint).cast<float>();
      inverse_bind.insert(inverse_bind.end(), matrix.data(), matrix.data() + matrix.size());
    }
    skin.inverseBindMatrices = Add(inverse_bind, TINYGLTF_TYPE_MAT4);
  }

  void AddAnimation() {
    const size_t frames = motion_.frames.size();
    std::vector<float> times, places;
    for (size_t frame = 0; frame < frames; ++frame) {
      times.push_back(static_cast<float>(static_cast<double>(frame) / motion_.fps));
      const Eigen::Vector3f place = motion_.frames[frame].root_position.cast<float>();
      places.insert(places.end(), place.begin(), place.end());
    }
    tinygltf::Animation animation;
    animation.name = "dance";
    animation.extras =
        tinygltf::Value(tinygltf::Value::Object{{"fps", tinygltf::Value(motion_.fps)}});
    const int input = Add(times, TINYGLTF_TYPE_SCALAR, 0, true);
    const auto channel = [&](int joint, const char* path, int output) {
      tinygltf::AnimationSampler& sampler = animation.samplers.emplace_back();
      sampler.input = input;
      sampler.output = output;
      sampler.interpolation = "LINEAR";
      tinygltf::AnimationChannel& target = animation.channels.emplace_back();
      target.sampler = static_cast<int>(animation.samplers.size()) - 1;
      target.target_node = joint;
      target.target_path = path;
    };
    channel(0, "translation", Add(places, TINYGLTF_TYPE_VEC3));
    for (int joint = 0; joint < skeleton_.joints(); ++joint) {
      std::vector<float> turns;
      for (const Pose& pose : motion_.frames)
        AppendTurn(QuaternionFromExp(pose.rotations.col(joint)), &turns);
      channel(joint, "rotation", Add(turns, TINYGLTF_TYPE_VEC4));
    }
    model_.animations.push_back(std::move(animation));
  }

  template <typename T>
  static constexpr int ComponentType() {
    if constexpr (std::is_same_v<T, float>) return TINYGLTF_COMPONENT_TYPE_FLOAT;
    if constexpr (std::is_same_v<T, uint32_t>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if constexpr (std::is_same_v<T, uint16_t>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    if constexpr (std::is_same_v<T, uint8_t>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  }

  // An accessor with a view of its own, whose elements are packed.
  template <typename T>
  int Add(const std::vector<T>& values, int type, int target = 0, bool bounds = false) {
    std::vector<unsigned char>& data = model_.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView& view = model_.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = values.size() * sizeof(T);
    view.target = target;
    data.resize(data.size() + view.byteLength);
    std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);

    const auto width = static_cast<size_t>(tinygltf::GetNumComponentsInType(type));
    tinygltf::Accessor& accessor = model_.accessors.emplace_back();
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = ComponentType<T>();
    accessor.type = type;
    accessor.count = values.size() / width;
    if (bounds) {
      accessor.minValues.assign(values.begin(), values.begin() + static_cast<ptrdiff_t>(width));
      accessor.maxValues = accessor.minValues;
      for (size_t i = 0; i < values.size(); ++i) {
        const double value = values[i];
        accessor.minValues[i % width] = std::min(accessor.minValues[i % width], value);
        accessor.maxValues[i % width] = std::max(accessor.maxValues[i % width], value);
      }
    }
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  const Skeleton& skeleton_;
  const Motion& motion_;
  tinygltf::Model model_;
  int body_node_ = -1;
};

}  // namespace

void WriteGlb(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion) {
  RequireWritable(skeleton, motion);
  const GlbBuilder builder(skeleton, motion);
  std::ostringstream bytes;
  tinygltf::TinyGLTF gltf;
  if (!gltf.WriteGltfSceneToStream(&builder.model(), bytes, false, true)) {
    throw Error(ErrorCode::kInternal, path.string(), "cannot be written as glTF");
  }
  WriteFile(path, bytes.view());
}

}  // namespace choreo
