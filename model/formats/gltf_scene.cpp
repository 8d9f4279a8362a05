#include "model/formats/gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "model/motion/pose_limits.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

constexpr double kSparseRate = 20;  // keys a second below which they are no frames
constexpr double kDefaultRate = 30;
constexpr double kMaxFrames = 1e6;
constexpr double kMaxPlaces = 3e7;  // of nodes in frames: a gigabyte, whatever a small file claims

}  // namespace

GltfScene::GltfScene(const tinygltf::Model& model) {
  ReadNodes(model);
  if (model.animations.empty()) throw InvalidArgument("animations", "there is none");
  for (const tinygltf::AnimationChannel& channel : model.animations[0].channels) {
    AddChannel(model, channel);
  }
  if (channels_.empty()) throw InvalidArgument("animations[0]", "moves no node");
  ChooseTimes(model.animations[0]);
}

int GltfScene::Find(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
}

std::vector<Eigen::Affine3d> GltfScene::Frame(int64_t frame) const {
  std::vector<Placement> local = rest_;
  const double time = start_ + static_cast<double>(frame) / fps_;
  for (const Channel& channel : channels_) channel.Drive(time, local[channel.node]);
  return Place(local);
}

void GltfScene::Channel::Drive(double time, Placement& placement) const {
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

void GltfScene::ReadNodes(const tinygltf::Model& model) {
  const size_t count = model.nodes.size();
  parents_.assign(count, -1);
  for (size_t i = 0; i < count; ++i) {
    const tinygltf::Node& node = model.nodes[i];
    names_.push_back(node.name);
    rest_.push_back(ReadPlacement(node, GltfItem("nodes", i)));
    for (const int child : node.children) {
      GltfAt(model.nodes, child, "nodes");
      if (std::exchange(parents_[static_cast<size_t>(child)], static_cast<int>(i)) >= 0)
        throw InvalidArgument(GltfItem("nodes", static_cast<size_t>(child)), "has two parents");
    }
  }
  // Parents first.
  for (size_t i = 0; i < count; ++i) {
    if (parents_[i] < 0) order_.push_back(i);
  }
  for (size_t i = 0; i < order_.size(); ++i) {
    for (const int child : model.nodes[order_[i]].children)
      order_.push_back(static_cast<size_t>(child));
  }
  if (order_.size() != count) throw InvalidArgument("nodes", "some are their own ancestors");
}

GltfScene::Placement GltfScene::ReadPlacement(const tinygltf::Node& node, const std::string& name) {
  Placement placement;
  if (node.matrix.size() == 16) {
    const Eigen::Affine3d transform(Eigen::Map<const Eigen::Matrix4d>(node.matrix.data()));
    Eigen::Matrix3d rotation, scaling;
    transform.computeRotationScaling(&rotation, &scaling);
    placement.translation = transform.translation();
    placement.rotation = Eigen::Quaterniond(rotation);
    placement.scale = scaling.diagonal();
  }
  if (node.translation.size() == 3)
    placement.translation = Eigen::Map<const Eigen::Vector3d>(node.translation.data());
  if (node.rotation.size() == 4)
    placement.rotation =
        Eigen::Quaterniond(Eigen::Map<const Eigen::Vector4d>(node.rotation.data())).normalized();
  if (node.scale.size() == 3)
    placement.scale = Eigen::Map<const Eigen::Vector3d>(node.scale.data());
  if (!placement.Transform().matrix().allFinite())
    throw InvalidArgument(name, "has a placement that is not finite");
  return placement;
}

void GltfScene::AddChannel(const tinygltf::Model& model,
                           const tinygltf::AnimationChannel& channel) {
  const tinygltf::Animation& animation = model.animations[0];
  const bool rotates = channel.target_path == "rotation";
  const bool scales = channel.target_path == "scale";
  // Shapes that morph, and extensions, move no joint.
  if (channel.target_node < 0 || !(rotates || scales || channel.target_path == "translation"))
    return;
  GltfAt(model.nodes, channel.target_node, "nodes");
  const tinygltf::AnimationSampler& sampler =
      GltfAt(animation.samplers, channel.sampler, "animations[0].samplers");
  const std::string name = GltfItem("animations[0].samplers", static_cast<size_t>(channel.sampler));
  if (sampler.interpolation == "CUBICSPLINE")
    throw InvalidArgument(name, "interpolates by CUBICSPLINE, must be LINEAR or STEP");
  Channel& added = channels_.emplace_back();
  added.node = static_cast<size_t>(channel.target_node);
  added.path = rotates  ? Channel::Path::kRotation
               : scales ? Channel::Path::kScale
                        : Channel::Path::kTranslation;
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
}

void GltfScene::ChooseTimes(const tinygltf::Animation& animation) {
  const Channel* densest = &channels_[0];
  start_ = channels_[0].times[0];
  double end = start_;
  for (const Channel& channel : channels_) {
    start_ = std::min(start_, channel.times[0]);
    end = std::max(end, channel.times[channel.times.size() - 1]);
    if (channel.times.size() > densest->times.size()) densest = &channel;
  }
  fps_ = kDefaultRate;
  const Eigen::Index keys = densest->times.size();
  if (keys > 1) {
    const double seconds = densest->times[keys - 1] - densest->times[0];
    fps_ = WholeRate(static_cast<double>(keys - 1) / seconds);
    if (fps_ < kSparseRate) fps_ = kDefaultRate;
  }
  if (animation.extras.IsObject() && animation.extras.Has("fps")) {
    const double stated = animation.extras.Get("fps").GetNumberAsDouble();
    if (!(stated >= 1 && stated <= 1000)) {
      throw InvalidArgument("animations[0].extras.fps",
                            std::to_string(stated) + ", must be 1 to 1000 frames a second");
    }
    fps_ = stated;
  }
  // Times are floats: the last frame may lie a little behind the end.
  const double frames = std::floor((end - start_) * fps_ + 0.01) + 1;
  if (!(frames <= kMaxFrames)) {
    throw InvalidArgument("animations[0]", std::to_string(end - start_) + " s at " +
                                               std::to_string(fps_) +
                                               " fps, at most 1000000 frames are read");
  }
  if (frames * static_cast<double>(names_.size()) > kMaxPlaces) {
    throw InvalidArgument("nodes", std::to_string(names_.size()) + " in " +
                                       std::to_string(static_cast<int64_t>(frames)) +
                                       " frames, at most 30000000 places are read");
  }
  frames_ = static_cast<int64_t>(frames);
}

std::vector<Eigen::Affine3d> GltfScene::Place(const std::vector<Placement>& local) const {
  std::vector<Eigen::Affine3d> world(local.size());
  for (const size_t node : order_) {
    world[node] = local[node].Transform();
    if (parents_[node] >= 0) world[node] = world[static_cast<size_t>(parents_[node])] * world[node];
    const double distance = world[node].translation().cwiseAbs().maxCoeff();
    if (!(distance <= kMaxPosition)) {
      std::ostringstream message;
      message << "stands at " << distance << " m, further than " << kMaxPosition
              << " m from the origin";
      throw InvalidArgument(GltfItem("nodes", node), message.str());
    }
  }
  return world;
}

}  // namespace choreo
