#include "model/formats/gltf/gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "model/core/grid.h"
#include "model/core/rounded.h"
#include "model/core/text/printable.h"
#include "model/formats/arrays/own_arrays.h"
#include "model/formats/gltf/glb_chunks.h"
#include "model/formats/gltf/gltf_document.h"
#include "model/formats/reading/node_motion.h"
#include "model/motion/pose/pose_limits.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

constexpr double kSparseRate = 20;  // keys a second; fewer are not frames
constexpr double kMaxFrames = 1e6;
constexpr size_t kMaxAnimations = 64;  // limit for hostile files
constexpr size_t kMaxNamed = 8;

std::string AnimationName(size_t animation) { return GltfItem("animations", animation); }

// `1 "walk" (2.5 s)`: its number, its name, if it has one, and its length.
std::string Label(const tinygltf::Model& model, size_t animation) {
  const std::string& name = model.animations[animation].name;
  double end = 0;
  for (const GltfChannel& channel : ReadGltfChannels(model, animation))
    end = std::max(end, channel.times[channel.times.size() - 1]);
  return std::to_string(animation) + (name.empty() ? "" : " \"" + Printable(name) + '"') + " (" +
         Rounded(end) + " s)";
}

std::string Labels(const tinygltf::Model& model, std::optional<size_t> but = {}) {
  std::string labels;
  for (size_t i = 0; i < std::min(model.animations.size(), kMaxNamed); ++i)
    if (i != but) labels += (labels.empty() ? "" : ", ") + Label(model, i);
  return labels + (model.animations.size() > kMaxNamed ? " ..." : "");
}

// The animation with this name or number.
size_t NamedAnimation(const tinygltf::Model& model, const std::string& name) {
  const auto named = std::ranges::find(model.animations, name, &tinygltf::Animation::name);
  if (!name.empty() && named != model.animations.end())
    return static_cast<size_t>(named - model.animations.begin());
  if (const auto number = NumberBelow(name, model.animations.size())) return *number;
  throw InvalidArgument("--animation", '"' + Printable(name) + "\" is none of its " +
                                           std::to_string(model.animations.size()) +
                                           " animations, " + Labels(model));
}

// The nodes that an animation moves: those with differing keys or, if none differ, with keys.
std::vector<bool> MovedBy(const std::vector<GltfChannel>& channels, size_t nodes) {
  std::vector<bool> moves(nodes), keyed(nodes);
  for (const GltfChannel& channel : channels) {
    keyed[channel.node] = true;
    if (channel.Moves()) moves[channel.node] = true;
  }
  return std::ranges::find(moves, true) == moves.end() ? keyed : moves;
}

int CountBones(const HumanBones& bones, const std::vector<bool>& nodes) {
  return static_cast<int>(
      std::ranges::count_if(bones.bones, [&](const auto& bone) { return nodes[bone.second]; }));
}

// Some exporters write one animation per node or limb. Combines all animations if each moves only a
// part of the body and no node is moved by two. Otherwise returns false.
bool TakeParts(const tinygltf::Model& model, const MotionReading& reading, GltfScene* scene) {
  std::vector<int> part(scene->nodes.names.size(), -1);
  std::vector<GltfChannel> channels;
  for (size_t i = 0; i < model.animations.size(); ++i) {
    for (GltfChannel& channel : ReadGltfChannels(model, i)) {
      int& owner = part[channel.node];
      if (owner >= 0 && owner != static_cast<int>(i)) return false;
      owner = static_cast<int>(i);
      channels.push_back(std::move(channel));
    }
  }
  RigNodes rig = scene->rig;
  rig.moves = MovedBy(channels, part.size());
  std::vector<int> bones(model.animations.size());
  int all = 0, most = 0;
  for (const auto& [bone, node] : FindBones(rig).bones) {
    if (!rig.moves[node]) continue;
    ++all;
    most = std::max(most, ++bones[part[node]]);
  }
  if (2 * most >= all) return false;
  reading.Note("each of its " + std::to_string(model.animations.size()) +
               " animations moves a part of the body: they are read as one, --animation chooses");
  scene->channels = std::move(channels);
  scene->rig.moves = std::move(rig.moves);
  return true;
}

// Sets the scene's channels and notes other animations. Returns the animation's number.
size_t ChooseAnimation(const tinygltf::Model& model, const MotionReading& reading,
                       GltfScene* scene) {
  if (model.animations.empty()) throw InvalidArgument("animations", "there is none");
  const size_t nodes = scene->nodes.names.size();
  if (!reading.animation.empty() || model.animations.size() == 1) {
    const size_t only = reading.animation.empty() ? 0 : NamedAnimation(model, reading.animation);
    scene->channels = ReadGltfChannels(model, only);
    if (scene->channels.empty()) throw InvalidArgument(AnimationName(only), "moves no node");
    scene->rig.moves = MovedBy(scene->channels, nodes);
    return only;
  }
  if (TakeParts(model, reading, scene)) return 0;
  size_t chosen = 0;
  int most = -1;
  for (size_t i = 0; i < std::min(model.animations.size(), kMaxAnimations); ++i) {
    std::vector<GltfChannel> channels = ReadGltfChannels(model, i);
    RigNodes rig = scene->rig;
    rig.moves = MovedBy(channels, nodes);
    // Prefers an animation that moves to one that holds a pose.
    const bool still = std::ranges::none_of(channels, &GltfChannel::Moves);
    const int moved = channels.empty() ? -1
                                       : CountBones(FindBones(rig), rig.moves) +
                                             (still ? 0 : static_cast<int>(nodes));
    if (moved > most) {
      chosen = i, most = moved;
      scene->channels = std::move(channels);
      scene->rig.moves = std::move(rig.moves);
    }
  }
  if (scene->channels.empty()) throw InvalidArgument("animations", "none moves a node");
  reading.Note("has " + std::to_string(model.animations.size()) + " animations; " +
               Label(model, chosen) + " is read, --animation chooses " + Labels(model, chosen));
  return chosen;
}

// The transforms of a skin's joints, and of the nodes that move with them, when the mesh was bound.
std::optional<std::vector<Eigen::Affine3d>> BoundPlaces(const tinygltf::Model& model,
                                                        const GltfNodes& nodes,
                                                        const HumanBones& body) {
  const tinygltf::Skin* largest = nullptr;
  std::ptrdiff_t most = 0;  // counts only the body's bones: hair may have more joints
  for (const tinygltf::Skin& skin : model.skins) {
    const auto bones = std::ranges::count_if(body.bones, [&](const auto& bone) {
      return std::ranges::find(skin.joints, bone.second) != skin.joints.end();
    });
    if (skin.inverseBindMatrices >= 0 && bones > most) largest = &skin, most = bones;
  }
  if (largest == nullptr) return std::nullopt;
  Eigen::MatrixXd inverse;
  try {
    inverse = ReadGltfAccessor(model, largest->inverseBindMatrices, TINYGLTF_TYPE_MAT4);
  } catch (const Error&) {
    return std::nullopt;  // for example if compressed: the nodes' own rest pose serves
  }
  const std::vector<Eigen::Affine3d> rest = nodes.PlaceAtRest();
  std::vector<Eigen::Affine3d> bound = rest;
  std::vector<bool> is_joint(rest.size());
  for (size_t i = 0; i < largest->joints.size(); ++i) {
    GltfAt(nodes.names, largest->joints[i], "skins.joints");
    if (static_cast<Eigen::Index>(i) >= inverse.cols()) return std::nullopt;
    const Eigen::Affine3d matrix(
        Eigen::Map<const Eigen::Matrix4d>(inverse.col(static_cast<Eigen::Index>(i)).data()));
    const Eigen::Affine3d place = matrix.inverse();
    if (!place.matrix().allFinite() || place.translation().norm() > kMaxPosition)
      return std::nullopt;
    bound[static_cast<size_t>(largest->joints[i])] = place;
    is_joint[static_cast<size_t>(largest->joints[i])] = true;
  }
  // Another node moves with a joint below it, or else with the one above it.
  const auto follow = [&](int node, int other) {
    bound[node] = bound[other] * rest[other].inverse() * rest[node];
    is_joint[node] = true;
  };
  for (size_t i = nodes.order.size(); i-- > 0;) {
    const auto node = static_cast<int>(nodes.order[i]);
    const int parent = nodes.parents[node];
    if (is_joint[node] && parent >= 0 && !is_joint[parent]) follow(parent, node);
  }
  for (const size_t node : nodes.order) {
    const int parent = nodes.parents[node];
    if (!is_joint[node] && parent >= 0 && is_joint[parent]) follow(static_cast<int>(node), parent);
  }
  const bool finite = std::ranges::all_of(
      bound, [](const Eigen::Affine3d& place) { return place.matrix().allFinite(); });
  return finite ? std::optional(bound) : std::nullopt;
}

// Some programs write milliseconds. Assumes so if keys are then at most 250 a second.
void CorrectTimes(const MotionReading& reading, GltfScene* scene) {
  constexpr double kFewKeys = 10, kFarApart = 4;
  double most_keys = 0, apart = 0;
  for (const GltfChannel& channel : scene->channels) {
    const Eigen::Index keys = channel.times.size();
    if (static_cast<double>(keys) <= most_keys) continue;
    most_keys = static_cast<double>(keys);
    apart = (channel.times[keys - 1] - channel.times[0]) / std::max(1.0, most_keys - 1);
  }
  if (most_keys < kFewKeys || !(apart >= kFarApart)) return;
  for (GltfChannel& channel : scene->channels) {
    channel.times /= 1000;
    if (channel.interpolation == GltfChannel::Interpolation::kCubic)
      channel.arrives *= 1000, channel.leaves *= 1000;
  }
  reading.Note("its keys stand " + Rounded(apart) +
               " s apart; their times are read as milliseconds");
}

void ChooseTimes(const tinygltf::Model& model, size_t number, const MotionReading& reading,
                 GltfScene& scene) {
  const tinygltf::Animation& animation = model.animations[number];
  const GltfChannel* densest = &scene.channels[0];
  scene.start = scene.channels[0].times[0];
  double end = scene.start;
  for (const GltfChannel& channel : scene.channels) {
    scene.start = std::min(scene.start, channel.times[0]);
    end = std::max(end, channel.times[channel.times.size() - 1]);
    if (channel.times.size() > densest->times.size()) densest = &channel;
  }
  if (scene.start >= 1) {
    reading.Note("its first key is at " + Rounded(scene.start) +
                 " s, which is the motion's beginning");
  }
  scene.fps = kModelFps;
  const Eigen::Index keys = densest->times.size();
  if (keys > 1) {
    const double seconds = densest->times[keys - 1] - densest->times[0];
    scene.fps = WholeRate(static_cast<double>(keys - 1) / seconds);
    if (scene.fps < kSparseRate) scene.fps = kModelFps;
  }
  if (animation.extras.IsObject() && animation.extras.Has("fps")) {
    scene.fps = CheckRate(AnimationName(number) + ".extras.fps",
                          animation.extras.Get("fps").GetNumberAsDouble());
  }
  // Times are floats: the last frame may lie a little after the end.
  const double frames = std::floor((end - scene.start) * scene.fps + 0.01) + 1;
  if (!(frames <= kMaxFrames)) {
    throw InvalidArgument(AnimationName(number), std::to_string(end - scene.start) + " s at " +
                                                     std::to_string(scene.fps) + " fps, at most " +
                                                     Rounded(kMaxFrames) + " frames are read");
  }
  if (frames * static_cast<double>(scene.nodes.names.size()) > kMaxPlaces) {
    throw InvalidArgument("nodes", std::to_string(scene.nodes.names.size()) + " in " +
                                       std::to_string(static_cast<int64_t>(frames)) +
                                       " frames, at most " + Rounded(kMaxPlaces) +
                                       " places are read");
  }
  scene.frames = static_cast<int64_t>(frames);
}

// Finds the body. A user who requests a body that does not exist may mean another animation.
HumanBones FindBodyOf(const tinygltf::Model& model, const RigNodes& rig,
                      const MotionReading& reading) {
  try {
    return FindBody(rig, reading);
  } catch (const Error& error) {
    if (error.field() != "--body" || model.animations.size() < 2) throw;
    throw Error(error.code(), "--body",
                error.Of("").what() + std::string("; of its animations, ") + Labels(model) +
                    ", --animation chooses");
  }
}

}  // namespace

std::vector<Eigen::Affine3d> GltfScene::Frame(int64_t frame) const {
  std::vector<GltfPlacement> local = nodes.rest;
  const double time = start + static_cast<double>(frame) / fps;
  for (const GltfChannel& channel : channels) channel.Drive(time, local[channel.node]);
  return nodes.Place(local);
}

GltfScene ReadGltfScene(const std::filesystem::path& path, const MotionReading& reading) {
  const std::string bytes = ReadGltfBytes(path);
  const nlohmann::ordered_json document = ParseGltfJson(bytes);
  const tinygltf::Model model = ParseGltfPart(document, bytes, GltfPart::kMotion);
  GltfScene scene;
  scene.nodes = ReadGltfNodes(model);
  scene.rig = ReadRigNodes(document, model);
  const size_t animation = ChooseAnimation(model, reading, &scene);
  MotionReading quietly = reading;
  quietly.notes = nullptr;
  scene.bound = BoundPlaces(model, scene.nodes, FindBodyOf(model, scene.rig, quietly));
  CorrectTimes(reading, &scene);
  ChooseTimes(model, animation, reading, scene);
  return scene;
}

}  // namespace choreo
