#include "model/formats/gltf/gltf_builder.h"

#include <algorithm>
#include <utility>

#include "model/core/error.h"
#include "model/formats/gltf/glb_chunks.h"

namespace choreo {

void GltfTrack::AddTurn(Eigen::Quaterniond turn) {
  Eigen::Quaternionf before = Eigen::Quaternionf::Identity();
  if (turns.size() >= 4) before = Eigen::Quaternionf(&*(turns.end() - 4));
  if (turn.dot(before.cast<double>()) < 0) turn.coeffs() = -turn.coeffs();
  const Eigen::Vector4f coefficients = turn.normalized().coeffs().cast<float>();  // x y z w
  turns.insert(turns.end(), coefficients.begin(), coefficients.end());
}

void GltfTrack::AddPlace(const Eigen::Vector3d& place) {
  const Eigen::Vector3f floats = place.cast<float>();
  places.insert(places.end(), floats.begin(), floats.end());
}

GltfBuilder::GltfBuilder(Json document, std::string_view binary)
    : document_(std::move(document)), binary_(binary) {
  Json& buffers = List("buffers");
  if (buffers.empty()) buffers.push_back({{"byteLength", 0}});
}

GltfBuilder::Json& GltfBuilder::List(const char* name) {
  Json& list = document_[name];
  if (list.is_null()) list = Json::array();
  if (!list.is_array()) throw InvalidArgument(name, "is not a list");
  return list;
}

size_t GltfBuilder::Width(std::string_view type) {
  return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

size_t GltfBuilder::AddBytes(std::string_view bytes, int component, size_t count,
                             std::string_view type, int target) {
  binary_.resize((binary_.size() + 3) / 4 * 4);
  Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  if (target != 0) view["target"] = target;
  binary_ += bytes;
  // A new list may move the others in memory.
  Json& views = List("bufferViews");
  views.push_back(std::move(view));
  const size_t view_index = views.size() - 1;
  Json& accessors = List("accessors");
  accessors.push_back(
      {{"bufferView", view_index}, {"componentType", component}, {"count", count}, {"type", type}});
  return accessors.size() - 1;
}

void GltfBuilder::SetBounds(const Eigen::MatrixXd& values) {
  const Eigen::VectorXd low = values.rowwise().minCoeff(), high = values.rowwise().maxCoeff();
  Json& accessor = List("accessors").back();
  accessor["min"] = std::vector<double>(low.begin(), low.end());
  accessor["max"] = std::vector<double>(high.begin(), high.end());
}

void GltfBuilder::AddDance(double fps, size_t frames, const std::vector<GltfTrack>& tracks) {
  std::vector<float> times;
  for (size_t frame = 0; frame < frames; ++frame)
    times.push_back(static_cast<float>(static_cast<double>(frame) / fps));
  const size_t input = Add<float>(times, "SCALAR", true);
  // A node that keeps one pose needs only the first time.
  const bool any_still = std::ranges::any_of(tracks, [&](const GltfTrack& track) {
    return track.node >= 0 && track.turns.size() == 4 && frames > 1;
  });
  const size_t start = any_still ? Add<float>(std::span(times).first(1), "SCALAR", true) : input;
  Json animation = {{"name", "dance"},
                    {"channels", Json::array()},
                    {"samplers", Json::array()},
                    {"extras", {{"fps", fps}}}};
  const auto channel = [&](int node, const char* path, size_t output, size_t when) {
    animation["samplers"].push_back(
        {{"input", when}, {"interpolation", "LINEAR"}, {"output", output}});
    animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                     {"target", {{"node", node}, {"path", path}}}});
  };
  for (const GltfTrack& track : tracks) {
    if (track.node < 0) continue;
    channel(track.node, "rotation", Add<float>(track.turns, "VEC4"),
            track.turns.size() == 4 ? start : input);
    if (!track.places.empty())
      channel(track.node, "translation", Add<float>(track.places, "VEC3"), input);
  }
  Json& animations = List("animations");
  animations.insert(animations.begin(), std::move(animation));
}

std::string GltfBuilder::Join(std::string_view others) {
  document_["buffers"][0]["byteLength"] = binary_.size();
  return JoinGlb({.json = document_.dump(), .binary = binary_, .others = others});
}

}  // namespace choreo
