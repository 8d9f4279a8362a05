#include "model/formats/gltf/gltf_channels.h"

#include <algorithm>
#include <string>

#include "model/core/error.h"
#include "model/formats/gltf/gltf_file.h"

namespace choreo {
namespace {

constexpr double kSameKey = 1e-6;

GltfChannel ReadGltfChannel(const tinygltf::Model& model, size_t animation,
                            const tinygltf::AnimationChannel& channel) {
  const bool rotates = channel.target_path == "rotation";
  const bool scales = channel.target_path == "scale";
  const std::string samplers = GltfItem("animations", animation) + ".samplers";
  GltfAt(model.nodes, channel.target_node, "nodes");
  const tinygltf::AnimationSampler& sampler =
      GltfAt(model.animations[animation].samplers, channel.sampler, samplers.c_str());
  const std::string name = GltfItem(samplers.c_str(), static_cast<size_t>(channel.sampler));
  GltfChannel added;
  added.node = static_cast<size_t>(channel.target_node);
  added.path = rotates  ? GltfChannel::Path::kRotation
               : scales ? GltfChannel::Path::kScale
                        : GltfChannel::Path::kTranslation;
  added.interpolation = sampler.interpolation == "STEP" ? GltfChannel::Interpolation::kStep
                        : sampler.interpolation == "CUBICSPLINE"
                            ? GltfChannel::Interpolation::kCubic
                            : GltfChannel::Interpolation::kLinear;
  added.times = ReadGltfAccessor(model, sampler.input, TINYGLTF_TYPE_SCALAR);
  added.values =
      ReadGltfAccessor(model, sampler.output, rotates ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
  const Eigen::Index keys = added.times.size();
  const Eigen::Index a_key = added.interpolation == GltfChannel::Interpolation::kCubic ? 3 : 1;
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

}  // namespace

std::vector<GltfChannel> ReadGltfChannels(const tinygltf::Model& model, size_t animation) {
  std::vector<GltfChannel> channels;
  for (const tinygltf::AnimationChannel& channel : model.animations[animation].channels) {
    const std::string& moved = channel.target_path;
    // Morph targets and extensions move no joints.
    if (channel.target_node >= 0 &&
        (moved == "translation" || moved == "rotation" || moved == "scale"))
      channels.push_back(ReadGltfChannel(model, animation, channel));
  }
  return channels;
}

void GltfChannel::Drive(double time, GltfPlacement& placement) const {
  const auto* const begin = times.data();
  const auto* const end = begin + times.size();
  // Tolerance for times that were rounded to 32 bits.
  constexpr double kSameTime = 1e-4;
  const Eigen::Index after = std::upper_bound(begin, end, time + kSameTime) - begin;
  const Eigen::Index a = std::max<Eigen::Index>(0, after - 1);
  const Eigen::Index b = std::min<Eigen::Index>(times.size() - 1, after);
  const double gap = times[b] - times[a];
  const double t = interpolation == Interpolation::kStep || gap <= 0
                       ? 0
                       : std::clamp((time - times[a]) / gap, 0.0, 1.0);
  Eigen::VectorXd value = values.col(a) + t * (values.col(b) - values.col(a));
  if (interpolation == Interpolation::kCubic) {  // Hermite, glTF 2.0, appendix C
    const double t2 = t * t, t3 = t2 * t;
    value = (2 * t3 - 3 * t2 + 1) * values.col(a) + gap * (t3 - 2 * t2 + t) * leaves.col(a) +
            (3 * t2 - 2 * t3) * values.col(b) + gap * (t3 - t2) * arrives.col(b);
  }
  if (path == Path::kRotation && interpolation == Interpolation::kCubic) {
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
         (interpolation == Interpolation::kCubic &&
          std::max(arrives.cwiseAbs().maxCoeff(), leaves.cwiseAbs().maxCoeff()) > kSameKey);
}

}  // namespace choreo
