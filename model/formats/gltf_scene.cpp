#include "model/formats/gltf_scene.h"

#include <algorithm>
#include <cmath>

#include "model/core/grid.h"
#include "model/core/rounded.h"
#include "model/formats/glb_chunks.h"
#include "model/formats/gltf_file.h"
#include "model/formats/own_arrays.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

constexpr double kSparseRate = 20;  // keys a second below which they are no frames
constexpr double kMaxFrames = 1e6;

GltfChannel ReadGltfChannel(const tinygltf::Model& model,
                            const tinygltf::AnimationChannel& channel) {
  const bool rotates = channel.target_path == "rotation";
  const bool scales = channel.target_path == "scale";
  GltfAt(model.nodes, channel.target_node, "nodes");
  const tinygltf::AnimationSampler& sampler =
      GltfAt(model.animations[0].samplers, channel.sampler, "animations[0].samplers");
  const std::string name = GltfItem("animations[0].samplers", static_cast<size_t>(channel.sampler));
  if (sampler.interpolation == "CUBICSPLINE")
    throw InvalidArgument(name, "interpolates by CUBICSPLINE, must be LINEAR or STEP");
  GltfChannel added;
  added.node = static_cast<size_t>(channel.target_node);
  added.path = rotates  ? GltfChannel::Path::kRotation
               : scales ? GltfChannel::Path::kScale
                        : GltfChannel::Path::kTranslation;
  added.step = sampler.interpolation == "STEP";
  added.times = ReadGltfAccessor(model, sampler.input, TINYGLTF_TYPE_SCALAR);
  added.values =
      ReadGltfAccessor(model, sampler.output, rotates ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
  if (added.values.cols() != added.times.size()) {
    throw InvalidArgument(name, std::to_string(added.values.cols()) + " values for " +
                                    std::to_string(added.times.size()) + " times");
  }
  for (Eigen::Index i = 1; i < added.times.size(); ++i) {
    if (!(added.times[i] > added.times[i - 1]))
      throw InvalidArgument(name, "has times that do not ascend");
  }
  if (rotates) {
    if (added.values.colwise().norm().minCoeff() < 1e-6)
      throw InvalidArgument(name, "has a rotation of length zero");
    added.values.colwise().normalize();
  }
  return added;
}

void ChooseTimes(const tinygltf::Animation& animation, GltfScene& scene) {
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
    scene.fps =
        CheckRate("animations[0].extras.fps", animation.extras.Get("fps").GetNumberAsDouble());
  }
  // Times are floats: the last frame may lie a little behind the end.
  const double frames = std::floor((end - scene.start) * scene.fps + 0.01) + 1;
  if (!(frames <= kMaxFrames)) {
    throw InvalidArgument("animations[0]", std::to_string(end - scene.start) + " s at " +
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
  const Eigen::Index after = std::upper_bound(begin, end, time) - begin;
  const Eigen::Index a = std::max<Eigen::Index>(0, after - 1);
  const Eigen::Index b = std::min<Eigen::Index>(times.size() - 1, after);
  const double gap = times[b] - times[a];
  const double t = step || gap <= 0 ? 0 : std::clamp((time - times[a]) / gap, 0.0, 1.0);
  if (path == Path::kRotation) {
    const Eigen::Quaterniond from(Eigen::Vector4d(values.col(a)));
    placement.rotation = from.slerp(t, Eigen::Quaterniond(Eigen::Vector4d(values.col(b))));
  } else {
    (path == Path::kScale ? placement.scale : placement.translation) =
        values.col(a) + t * (values.col(b) - values.col(a));
  }
}

std::vector<Eigen::Affine3d> GltfScene::Frame(int64_t frame) const {
  std::vector<GltfPlacement> local = nodes.rest;
  const double time = start + static_cast<double>(frame) / fps;
  for (const GltfChannel& channel : channels) channel.Drive(time, local[channel.node]);
  return nodes.Place(local);
}

GltfScene ReadGltfScene(const std::filesystem::path& path) {
  const tinygltf::Model model = ParseGlb(ReadGlbBytes(path));
  GltfScene scene;
  scene.nodes = ReadGltfNodes(model);
  if (model.animations.empty()) throw InvalidArgument("animations", "there is none");
  for (const tinygltf::AnimationChannel& channel : model.animations[0].channels) {
    const std::string& moved = channel.target_path;
    // Shapes that morph, and extensions, move no joint.
    if (channel.target_node >= 0 &&
        (moved == "translation" || moved == "rotation" || moved == "scale"))
      scene.channels.push_back(ReadGltfChannel(model, channel));
  }
  if (scene.channels.empty()) throw InvalidArgument("animations[0]", "moves no node");
  ChooseTimes(model.animations[0], scene);
  return scene;
}

}  // namespace choreo
