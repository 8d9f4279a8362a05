#include "model/formats/gltf_scene.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "model/core/grid.h"
#include "model/core/printable.h"
#include "model/core/rounded.h"
#include "model/formats/glb_chunks.h"
#include "model/formats/gltf_document.h"
#include "model/formats/own_arrays.h"
#include "model/motion/pose_limits.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

constexpr double kSparseRate = 20;  // keys a second below which they are no frames
constexpr double kMaxFrames = 1e6;
constexpr double kSameKey = 1e-6;
constexpr size_t kMostAnimations = 64;  // that are looked at, of a hostile file's
constexpr size_t kMostNamed = 8;

std::string AnimationName(size_t animation) { return GltfItem("animations", animation); }

GltfChannel ReadGltfChannel(const tinygltf::Model& model, size_t animation,
                            const tinygltf::AnimationChannel& channel) {
  const bool rotates = channel.target_path == "rotation";
  const bool scales = channel.target_path == "scale";
  const std::string samplers = AnimationName(animation) + ".samplers";
  GltfAt(model.nodes, channel.target_node, "nodes");
  const tinygltf::AnimationSampler& sampler =
      GltfAt(model.animations[animation].samplers, channel.sampler, samplers.c_str());
  const std::string name = GltfItem(samplers.c_str(), static_cast<size_t>(channel.sampler));
  GltfChannel added;
  added.node = static_cast<size_t>(channel.target_node);
  added.path = rotates  ? GltfChannel::Path::kRotation
               : scales ? GltfChannel::Path::kScale
                        : GltfChannel::Path::kTranslation;
  added.way = sampler.interpolation == "STEP"          ? GltfChannel::Way::kStep
              : sampler.interpolation == "CUBICSPLINE" ? GltfChannel::Way::kCubic
                                                       : GltfChannel::Way::kLinear;
  added.times = ReadGltfAccessor(model, sampler.input, TINYGLTF_TYPE_SCALAR);
  added.values =
      ReadGltfAccessor(model, sampler.output, rotates ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
  const Eigen::Index keys = added.times.size();
  const Eigen::Index a_key = added.way == GltfChannel::Way::kCubic ? 3 : 1;
  if (added.values.cols() != a_key * keys) {
    throw InvalidArgument(name, std::to_string(added.values.cols()) + " values for " +
                                    std::to_string(keys) + " times" +
                                    (a_key == 3 ? ", a CUBICSPLINE has three each" : ""));
  }
  if (a_key == 3) {
    const Eigen::MatrixXd all = added.values;
    const auto every_third = [&](Eigen::Index first) -> Eigen::MatrixXd {
      return all(Eigen::all, Eigen::seqN(first, keys, 3));
    };
    added.arrives = every_third(0);
    added.values = every_third(1);
    added.leaves = every_third(2);
  }
  for (Eigen::Index i = 1; i < added.times.size(); ++i) {
    if (!(added.times[i] > added.times[i - 1]))
      throw InvalidArgument(name, "has times that do not ascend");
  }
  if (rotates) {
    if (added.values.colwise().norm().minCoeff() < 1e-6)
      throw InvalidArgument(name, "has a rotation of length zero");
    if (a_key == 1) added.values.colwise().normalize();
  }
  return added;
}

std::vector<GltfChannel> ReadGltfChannels(const tinygltf::Model& model, size_t animation) {
  std::vector<GltfChannel> channels;
  for (const tinygltf::AnimationChannel& channel : model.animations[animation].channels) {
    const std::string& moved = channel.target_path;
    // Shapes that morph, and extensions, move no joint.
    if (channel.target_node >= 0 &&
        (moved == "translation" || moved == "rotation" || moved == "scale"))
      channels.push_back(ReadGltfChannel(model, animation, channel));
  }
  return channels;
}

// The animation of this name, or of this number.
size_t NamedAnimation(const tinygltf::Model& model, const std::string& name) {
  std::string names;
  for (size_t i = 0; i < model.animations.size(); ++i) {
    if (model.animations[i].name == name) return i;
    names += (i == 0 ? "\"" : ", \"") + Printable(model.animations[i].name) + '"';
  }
  size_t number = 0;
  const auto [end, code] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (code == std::errc() && end == name.data() + name.size() && number < model.animations.size())
    return number;
  throw InvalidArgument("--animation", '"' + Printable(name) + "\" is none of its " +
                                           std::to_string(model.animations.size()) +
                                           " animations, " + names);
}

// What an animation moves: keys that differ or, where none do, keys.
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

// Sets the scene's channels, and says what else there is. Returns the animation's number.
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
  size_t chosen = 0;
  int most = -1;
  std::string others;
  for (size_t i = 0; i < std::min(model.animations.size(), kMostAnimations); ++i) {
    std::vector<GltfChannel> channels = ReadGltfChannels(model, i);
    RigNodes rig = scene->rig;
    rig.moves = MovedBy(channels, nodes);
    // One that moves goes before one that holds a pose, whatever has keys there.
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
  for (size_t i = 0; i < std::min(model.animations.size(), kMostNamed); ++i) {
    if (i != chosen)
      others += (others.empty() ? "\"" : ", \"") + Printable(model.animations[i].name) + '"';
  }
  reading.Note("has " + std::to_string(model.animations.size()) + " animations; \"" +
               Printable(model.animations[chosen].name) + "\" is read, --animation chooses " +
               others + (model.animations.size() > kMostNamed ? " ..." : ""));
  return chosen;
}

// Where a skin's joints, and with them the other nodes, were when the mesh was bound to them.
std::optional<std::vector<Eigen::Affine3d>> BoundPlaces(const tinygltf::Model& model,
                                                        const GltfNodes& nodes) {
  const tinygltf::Skin* largest = nullptr;
  for (const tinygltf::Skin& skin : model.skins) {
    if (skin.inverseBindMatrices >= 0 && (!largest || skin.joints.size() > largest->joints.size()))
      largest = &skin;
  }
  if (largest == nullptr) return std::nullopt;
  Eigen::MatrixXd inverse;
  try {
    inverse = ReadGltfAccessor(model, largest->inverseBindMatrices, TINYGLTF_TYPE_MAT4);
  } catch (const Error&) {
    return std::nullopt;  // compressed, say: the nodes' own rest pose will do
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
  // What is no joint goes along with a joint below it, else with the one above it.
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

void ChooseTimes(const tinygltf::Model& model, size_t number, GltfScene& scene) {
  const tinygltf::Animation& animation = model.animations[number];
  const GltfChannel* densest = &scene.channels[0];
  scene.start = scene.channels[0].times[0];
  double end = scene.start;
  for (const GltfChannel& channel : scene.channels) {
    scene.start = std::min(scene.start, channel.times[0]);
    end = std::max(end, channel.times[channel.times.size() - 1]);
    if (channel.times.size() > densest->times.size()) densest = &channel;
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
  // Times are floats: the last frame may lie a little behind the end.
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

}  // namespace

void GltfChannel::Drive(double time, GltfPlacement& placement) const {
  const auto* const begin = times.data();
  const auto* const end = begin + times.size();
  // A third of a second is another number in 32 bits than in 64.
  constexpr double kSameTime = 1e-4;
  const Eigen::Index after = std::upper_bound(begin, end, time + kSameTime) - begin;
  const Eigen::Index a = std::max<Eigen::Index>(0, after - 1);
  const Eigen::Index b = std::min<Eigen::Index>(times.size() - 1, after);
  const double gap = times[b] - times[a];
  const double t =
      way == Way::kStep || gap <= 0 ? 0 : std::clamp((time - times[a]) / gap, 0.0, 1.0);
  Eigen::VectorXd value = values.col(a) + t * (values.col(b) - values.col(a));
  if (way == Way::kCubic) {  // Hermite, glTF 2.0, appendix C
    const double t2 = t * t, t3 = t2 * t;
    value = (2 * t3 - 3 * t2 + 1) * values.col(a) + gap * (t3 - 2 * t2 + t) * leaves.col(a) +
            (3 * t2 - 2 * t3) * values.col(b) + gap * (t3 - t2) * arrives.col(b);
  }
  if (path == Path::kRotation && way == Way::kCubic) {
    if (value.norm() > 1e-9)
      placement.rotation = Eigen::Quaterniond(Eigen::Vector4d(value.normalized()));
  } else if (path == Path::kRotation) {
    const Eigen::Quaterniond from(Eigen::Vector4d(values.col(a)));
    placement.rotation = from.slerp(t, Eigen::Quaterniond(Eigen::Vector4d(values.col(b))));
  } else {
    (path == Path::kScale ? placement.scale : placement.translation) = value;
  }
}

bool GltfChannel::Moves() const {
  return ((values.colwise() - values.col(0).eval()).cwiseAbs().maxCoeff() > kSameKey) ||
         (way == Way::kCubic &&
          std::max(arrives.cwiseAbs().maxCoeff(), leaves.cwiseAbs().maxCoeff()) > kSameKey);
}

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
  scene.bound = BoundPlaces(model, scene.nodes);
  ChooseTimes(model, animation, scene);
  return scene;
}

}  // namespace choreo
