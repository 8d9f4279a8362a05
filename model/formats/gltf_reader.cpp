#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include "model/core/error.h"
#include "model/formats/gltf.h"
#include "model/motion/fit.h"
#include "model/motion/fit_sources.h"
#include "model/motion/resample.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kSameRest = 0.002;  // metres
constexpr double kSparseRate = 20;   // keys a second below which they are no frames
constexpr double kDefaultRate = 30;
constexpr double kMaxFrames = 1e6;

// In one expression GCC 12 sees an overlap in operator+ that is not there (-Wrestrict).
std::string Item(const char* list, size_t index) {
  std::string item = list;
  item.append("[").append(std::to_string(index)).append("]");
  return item;
}

template <typename T>
const T& At(const std::vector<T>& list, int index, const char* name) {
  if (index < 0 || static_cast<size_t>(index) >= list.size()) {
    throw InvalidArgument(name, "there is no number " + std::to_string(index) + " among " +
                                    std::to_string(list.size()));
  }
  return list[static_cast<size_t>(index)];
}

tinygltf::Model Parse(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened");
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  tinygltf::TinyGLTF gltf;
  // A motion comes from one file: no others are opened, and pictures are not looked at.
  gltf.SetFsCallbacks(
      {[](const std::string&, void*) { return false; },
       [](const std::string& name, void*) { return name; },
       [](std::vector<unsigned char>*, std::string* error, const std::string& name, void*) {
         if (error) *error += "the file beside it, " + name + ", is not read";
         return false;
       },
       [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
         return false;
       },
       nullptr});
  gltf.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                         const unsigned char*, int, void*) { return true; },
                      nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  if (bytes.size() > UINT32_MAX ||
      !gltf.LoadBinaryFromMemory(&model, &error, &warning, data,
                                 static_cast<unsigned>(bytes.size()))) {
    error.erase(std::find(error.begin(), error.end(), '\n'), error.end());
    throw InvalidArgument("", "is no binary glTF: " + (error.empty() ? "bad header" : error));
  }
  return model;
}

// An accessor's elements, [components, count]; normalised integers become -1 to 1.
Eigen::MatrixXd ReadAccessor(const tinygltf::Model& model, int index, int type) {
  const tinygltf::Accessor& accessor = At(model.accessors, index, "accessors");
  const std::string name = Item("accessors", static_cast<size_t>(index));
  if (accessor.sparse.isSparse) throw InvalidArgument(name, "is sparse, which is not read");
  if (accessor.type != type) throw InvalidArgument(name, "has elements of another kind");
  const tinygltf::BufferView& view =
      At(model.bufferViews, accessor.bufferView, (name + ".bufferView").c_str());
  const tinygltf::Buffer& buffer = At(model.buffers, view.buffer, "buffers");
  const int rows = tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type));
  const int size = tinygltf::GetComponentSizeInBytes(accessor.componentType);
  const int stride = accessor.ByteStride(view);
  const bool integer = accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (size < 1 || stride < rows * size || (integer && (!accessor.normalized || size > 2))) {
    throw InvalidArgument(name, "has components that are neither floats nor normalized");
  }
  const uint64_t available = buffer.data.size();
  const uint64_t first = uint64_t{view.byteOffset} + accessor.byteOffset;
  if (accessor.count < 1 || accessor.count > available || first > available ||
      first + (accessor.count - 1) * static_cast<uint64_t>(stride) +
              static_cast<uint64_t>(rows * size) >
          available) {
    throw InvalidArgument(name,
                          "reaches beyond its buffer of " + std::to_string(available) + " bytes");
  }
  const auto component = [&](const unsigned char* at) -> double {
    const auto as = [at]<typename T>(T value) {
      std::memcpy(&value, at, sizeof(T));
      return static_cast<double>(value);
    };
    switch (accessor.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return std::max(as(int8_t{}) / 127, -1.0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return as(uint8_t{}) / 255;
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return std::max(as(int16_t{}) / 32767, -1.0);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return as(uint16_t{}) / 65535;
      default:
        return as(float{});
    }
  };
  Eigen::MatrixXd values(rows, static_cast<Eigen::Index>(accessor.count));
  for (size_t i = 0; i < accessor.count; ++i) {
    for (int row = 0; row < rows; ++row) {
      const size_t offset = first + i * static_cast<size_t>(stride) +
                            static_cast<size_t>(row) * static_cast<size_t>(size);
      values(row, static_cast<Eigen::Index>(i)) = component(buffer.data.data() + offset);
    }
  }
  if (!values.allFinite()) throw InvalidArgument(name, "holds values that are not finite");
  return values;
}

struct Placement {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();

  Eigen::Affine3d Transform() const {
    return Eigen::Translation3d(translation) * rotation * Eigen::Scaling(scale);
  }
};

struct Channel {
  enum class Path { kTranslation, kRotation, kScale };
  size_t node;
  Path path;
  bool step;
  Eigen::RowVectorXd times;  // [keys] ascending, seconds
  Eigen::MatrixXd values;    // [3 or 4, keys]

  // Sets what it drives to its value at `time`; before the first and after the last key it holds.
  void Drive(double time, Placement& placement) const {
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
};

// The nodes of a file and what moves them.
class Scene {
 public:
  explicit Scene(const tinygltf::Model& model) {
    ReadNodes(model);
    if (model.animations.empty()) throw InvalidArgument("animations", "there is none");
    for (const tinygltf::AnimationChannel& channel : model.animations[0].channels) {
      AddChannel(model, channel);
    }
    if (channels_.empty()) throw InvalidArgument("animations[0]", "moves no node");
    ChooseTimes(model.animations[0]);
  }

  double fps() const { return fps_; }
  int64_t frames() const { return frames_; }
  const std::vector<std::string>& names() const { return names_; }
  int parent(int node) const { return parents_[static_cast<size_t>(node)]; }
  int Find(const std::string& name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
  }

  // Where all nodes are in the world.
  std::vector<Eigen::Affine3d> Rest() const { return Place(rest_); }
  std::vector<Eigen::Affine3d> Frame(int64_t frame) const {
    std::vector<Placement> local = rest_;
    const double time = start_ + static_cast<double>(frame) / fps_;
    for (const Channel& channel : channels_) channel.Drive(time, local[channel.node]);
    return Place(local);
  }

 private:
  void ReadNodes(const tinygltf::Model& model) {
    const size_t count = model.nodes.size();
    parents_.assign(count, -1);
    for (size_t i = 0; i < count; ++i) {
      const tinygltf::Node& node = model.nodes[i];
      names_.push_back(node.name);
      rest_.push_back(ReadPlacement(node, Item("nodes", i)));
      for (const int child : node.children) {
        At(model.nodes, child, "nodes");
        if (std::exchange(parents_[static_cast<size_t>(child)], static_cast<int>(i)) >= 0)
          throw InvalidArgument(Item("nodes", static_cast<size_t>(child)), "has two parents");
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

  static Placement ReadPlacement(const tinygltf::Node& node, const std::string& name) {
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

  void AddChannel(const tinygltf::Model& model, const tinygltf::AnimationChannel& channel) {
    const tinygltf::Animation& animation = model.animations[0];
    const bool rotates = channel.target_path == "rotation";
    const bool scales = channel.target_path == "scale";
    // Shapes that morph, and extensions, move no joint.
    if (channel.target_node < 0 || !(rotates || scales || channel.target_path == "translation"))
      return;
    At(model.nodes, channel.target_node, "nodes");
    const tinygltf::AnimationSampler& sampler =
        At(animation.samplers, channel.sampler, "animations[0].samplers");
    const std::string name = Item("animations[0].samplers", static_cast<size_t>(channel.sampler));
    if (sampler.interpolation == "CUBICSPLINE")
      throw InvalidArgument(name, "interpolates by CUBICSPLINE, must be LINEAR or STEP");
    Channel& added = channels_.emplace_back();
    added.node = static_cast<size_t>(channel.target_node);
    added.path = rotates  ? Channel::Path::kRotation
                 : scales ? Channel::Path::kScale
                          : Channel::Path::kTranslation;
    added.step = sampler.interpolation == "STEP";
    added.times = ReadAccessor(model, sampler.input, TINYGLTF_TYPE_SCALAR);
    added.values =
        ReadAccessor(model, sampler.output, rotates ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
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

  void ChooseTimes(const tinygltf::Animation& animation) {
    const Channel* densest = &channels_[0];
    start_ = channels_[0].times[0];
    double end = start_;
    for (const Channel& channel : channels_) {
      start_ = std::min(start_, channel.times[0]);
      end = std::max(end, channel.times[channel.times.size() - 1]);
      if (channel.times.size() > densest->times.size()) densest = &channel;
    }
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
    frames_ = static_cast<int64_t>(frames);
  }

  std::vector<Eigen::Affine3d> Place(const std::vector<Placement>& local) const {
    std::vector<Eigen::Affine3d> world(local.size());
    for (const size_t node : order_) {
      world[node] = local[node].Transform();
      if (parents_[node] >= 0)
        world[node] = world[static_cast<size_t>(parents_[node])] * world[node];
    }
    return world;
  }

  std::vector<std::string> names_;
  std::vector<int> parents_;
  std::vector<size_t> order_;
  std::vector<Placement> rest_;
  std::vector<Channel> channels_;
  double fps_ = kDefaultRate;
  double start_ = 0;
  int64_t frames_ = 0;
};

// The nodes that are our joints, or nothing if the file's skeleton is another one.
std::optional<std::vector<int>> FindOurs(const Scene& scene, const Skeleton& skeleton) {
  const std::vector<Eigen::Affine3d> rest = scene.Rest();
  std::vector<int> nodes;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const int node = scene.Find(skeleton.joint_names[joint]);
    if (node < 0) return std::nullopt;
    if (joint > 0) {
      const int parent = nodes[skeleton.parents[joint]];
      const Eigen::Vector3d offset = rest[node].translation() - rest[parent].translation();
      if (scene.parent(node) != parent ||
          (offset - skeleton.offsets.col(joint)).norm() > kSameRest) {
        return std::nullopt;
      }
    }
    nodes.push_back(node);
  }
  return nodes;
}

Motion TakeOurs(const Scene& scene, const std::vector<int>& nodes, const Skeleton& skeleton) {
  const auto turn = [](const Eigen::Affine3d& transform) -> Eigen::Matrix3d {
    return transform.linear().colwise().normalized();
  };
  const std::vector<Eigen::Affine3d> rest = scene.Rest();
  Motion motion;
  motion.fps = scene.fps();
  for (int64_t frame = 0; frame < scene.frames(); ++frame) {
    const std::vector<Eigen::Affine3d> now = scene.Frame(frame);
    Pose& pose = motion.frames.emplace_back();
    pose.root_position = now[nodes[0]].translation();
    pose.rotations.resize(3, skeleton.joints());
    std::vector<Eigen::Matrix3d> since_rest;
    for (int joint = 0; joint < skeleton.joints(); ++joint) {
      since_rest.push_back(turn(now[nodes[joint]]) * turn(rest[nodes[joint]]).transpose());
      const int parent = skeleton.parents[joint];
      const Eigen::Matrix3d local =
          parent < 0 ? since_rest[joint] : since_rest[parent].transpose() * since_rest[joint];
      pose.rotations.col(joint) = LogMap(local);
    }
  }
  MakeContinuous(motion);
  return motion;
}

Motion FitOthers(const Scene& scene, const Skeleton& skeleton) {
  PositionClip clip;
  clip.fps = scene.fps();
  clip.joint_names = scene.names();
  for (int64_t frame = 0; frame < scene.frames(); ++frame) {
    const std::vector<Eigen::Affine3d> now = scene.Frame(frame);
    Eigen::Matrix3Xd& positions = clip.frames.emplace_back(3, now.size());
    for (size_t node = 0; node < now.size(); ++node)
      positions.col(static_cast<Eigen::Index>(node)) = now[node].translation();
  }
  return FitClip(clip, BvhSource(clip), skeleton).motion;
}

}  // namespace

Motion ReadGlb(const std::filesystem::path& path, const Skeleton& skeleton) {
  try {
    const Scene scene(Parse(path));
    const auto ours = FindOurs(scene, skeleton);
    return ours ? TakeOurs(scene, *ours, skeleton) : FitOthers(scene, skeleton);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kNotFound) throw;
    throw Error(error.code(), path.string(), error.what());
  }
}

}  // namespace choreo
