#include "model/formats/gltf/gltf_document.h"

#include <charconv>
#include <initializer_list>
#include <string>
#include <string_view>

#include "model/core/error.h"
#include "model/core/files/json_limits.h"
#include "model/formats/gltf/glb_chunks.h"
#include "model/formats/gltf/gltf_nodes.h"

namespace choreo {
namespace {

using nlohmann::ordered_json;

// The bone names that VRM's extensions give to nodes.
std::vector<std::string> VrmNames(const ordered_json& document, size_t nodes) {
  std::vector<std::string> names(nodes);
  const auto name = [&](const std::string& bone, const ordered_json& value) {
    const auto node = value.find("node");
    if (node == value.end() || !node->is_number_unsigned() || node->get<uint64_t>() >= nodes)
      return;
    names[node->get<size_t>()] = bone;
  };
  using Pointer = ordered_json::json_pointer;
  for (const char* now : {"/extensions/VRMC_vrm/humanoid/humanBones",
                          "/extensions/VRMC_vrm_animation/humanoid/humanBones"}) {
    const Pointer table(now);
    if (!document.contains(table) || !document[table].is_object()) continue;
    for (const auto& [bone, value] : document[table].items()) {
      if (value.is_object()) name(bone, value);
    }
    return names;
  }
  const Pointer before("/extensions/VRM/humanoid/humanBones");
  if (!document.contains(before) || !document[before].is_array()) return names;
  for (const ordered_json& value : document[before]) {
    if (!value.is_object()) continue;
    const auto bone = value.find("bone");
    if (bone != value.end() && bone->is_string()) name(bone->get<std::string>(), value);
  }
  return names;
}

/// Copies lists of objects with only some of their members.
class BareCopy {
 public:
  explicit BareCopy(const ordered_json& document) : document_(document) {}

  void List(const char* list, std::initializer_list<const char*> members) {
    const auto all = document_.find(list);
    if (all == document_.end()) return;
    if (!all->is_array()) throw InvalidArgument(list, "is not a list");
    ordered_json& copies = bare_[list] = ordered_json::array();
    for (const ordered_json& one : *all) {
      if (!one.is_object())
        throw InvalidArgument(GltfItem(list, copies.size()), "is not an object");
      ordered_json& copied = copies.emplace_back(ordered_json::object());
      for (const char* member : members)
        if (one.contains(member)) copied[member] = one[member];
    }
  }

  // Converts a target of KHR_animation_pointer to glTF's own form, if possible.
  static void ResolvePointer(ordered_json* target) {
    if (target->value("path", ordered_json()) != "pointer" || !target->contains("extensions"))
      return;
    const ordered_json& extensions = (*target)["extensions"];
    if (!extensions.is_object() || !extensions.contains("KHR_animation_pointer")) return;
    const ordered_json& pointer = extensions["KHR_animation_pointer"];
    if (!pointer.is_object() || !pointer.contains("pointer") || !pointer["pointer"].is_string())
      return;
    const std::string text = pointer["pointer"].get<std::string>();
    constexpr std::string_view kNodes = "/nodes/";
    if (!text.starts_with(kNodes)) return;
    int node = 0;
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data() + kNodes.size(), end, node);
    if (error != std::errc() || rest == end || *rest != '/') return;
    *target = {{"node", node}, {"path", std::string(rest + 1, end)}};
  }

  // Drops channels that do not move nodes.
  void DropOtherChannels() {
    if (!bare_.contains("animations")) return;
    for (ordered_json& animation : bare_["animations"]) {
      if (!animation.contains("channels") || !animation["channels"].is_array()) continue;
      ordered_json kept = ordered_json::array();
      for (ordered_json channel : animation["channels"]) {
        if (channel.is_object() && channel.contains("target") && channel["target"].is_object())
          ResolvePointer(&channel["target"]);
        if (channel.is_object() && channel.contains("target") && channel["target"].is_object() &&
            channel["target"].contains("node"))
          kept.push_back(channel);
      }
      animation["channels"] = kept;
    }
  }

  // Buffers that a compression extension would fill have no data of their own.
  void FillEmptyBuffers() {
    if (!bare_.contains("buffers")) return;
    for (size_t i = 1; i < bare_["buffers"].size(); ++i) {
      ordered_json& buffer = bare_["buffers"][i];
      if (!buffer.contains("uri"))
        buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
    }
  }

  const ordered_json& bare() const { return bare_; }

 private:
  const ordered_json& document_;
  ordered_json bare_ = {{"asset", {{"version", "2.0"}}}};
};

}  // namespace

ordered_json ParseGltfJson(std::string_view glb) {
  const std::string_view text = SplitGlb(glb).json;
  CheckJsonDepth(text, "");
  ordered_json document = ordered_json::parse(text, nullptr, false);
  if (!document.is_object())
    throw InvalidArgument("", "is not a binary glTF: its JSON is not an object");
  return document;
}

tinygltf::Model ParseGltfPart(const ordered_json& document, std::string_view glb, GltfPart part) {
  BareCopy copy(document);
  copy.List("nodes", {"name", "children", "translation", "rotation", "scale", "matrix"});
  if (part == GltfPart::kNodes) {
    copy.List("skins", {"joints"});
    const std::string json = copy.bare().dump();
    return ParseGlb(JoinGlb({.json = json, .binary = {}, .others = {}}));
  }
  copy.List("skins", {"joints", "inverseBindMatrices"});
  copy.List("accessors",
            {"bufferView", "byteOffset", "componentType", "normalized", "count", "type", "sparse"});
  copy.List("bufferViews", {"buffer", "byteOffset", "byteLength", "byteStride", "extensions"});
  copy.List("buffers", {"uri", "byteLength"});
  copy.List("animations", {"name", "channels", "samplers", "extras"});
  copy.DropOtherChannels();
  copy.FillEmptyBuffers();
  const std::string json = copy.bare().dump();
  return ParseGlb(JoinGlb({.json = json, .binary = SplitGlb(glb).binary, .others = {}}));
}

RigNodes ReadRigNodes(const ordered_json& document, const tinygltf::Model& model) {
  const GltfNodes nodes = ReadGltfNodes(model);
  const size_t count = nodes.names.size();
  RigNodes rig{.names = nodes.names,
               .parents = nodes.parents,
               .places = PlacesOf(nodes.PlaceAtRest()),
               .joints = std::vector<bool>(count, model.skins.empty()),
               .moves = std::vector<bool>(count),
               .meshes = std::vector<bool>(count)};
  for (const tinygltf::Skin& skin : model.skins) {
    for (const int joint : skin.joints) {
      GltfAt(model.nodes, joint, "skins.joints");
      rig.joints[static_cast<size_t>(joint)] = true;
    }
  }
  if (document.contains("nodes") && document["nodes"].is_array()) {
    for (size_t node = 0; node < count; ++node)
      rig.meshes[node] = document["nodes"][node].contains("mesh");
  }
  rig.table = FindHumanBones(VrmNames(document, count));
  return rig;
}

}  // namespace choreo
