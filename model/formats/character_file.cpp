#include "model/formats/character_file.h"

#include <initializer_list>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/core/json_limits.h"
#include "model/formats/glb_chunks.h"
#include "model/formats/gltf_file.h"

namespace choreo {
namespace {

using nlohmann::ordered_json;

// Of nodes, the names that VRM's extension (0.x or 1.0) gives to them.
std::vector<std::string> VrmNames(const ordered_json& document, size_t nodes) {
  std::vector<std::string> names(nodes);
  const auto name = [&](const std::string& bone, const ordered_json& value) {
    const auto node = value.find("node");
    if (node == value.end() || !node->is_number_unsigned() || node->get<uint64_t>() >= nodes)
      return;
    names[node->get<size_t>()] = bone;
  };
  using Pointer = ordered_json::json_pointer;
  const Pointer now("/extensions/VRMC_vrm/humanoid/humanBones");
  const Pointer before("/extensions/VRM/humanoid/humanBones");
  if (document.contains(now) && document[now].is_object()) {
    for (const auto& [bone, value] : document[now].items()) {
      if (value.is_object()) name(bone, value);
    }
  } else if (document.contains(before) && document[before].is_array()) {
    for (const ordered_json& value : document[before]) {
      if (!value.is_object()) continue;
      const auto bone = value.find("bone");
      if (bone != value.end() && bone->is_string()) name(bone->get<std::string>(), value);
    }
  }
  return names;
}

// Only nodes and the joints of skins: of other parts the parser would refuse what it does not know,
// such as compressed meshes.
tinygltf::Model ParseNodes(const ordered_json& document) {
  ordered_json bare = {{"asset", {{"version", "2.0"}}}};
  const auto copy = [&](const char* list, std::initializer_list<const char*> members) {
    const auto all = document.find(list);
    if (all == document.end()) return;
    if (!all->is_array()) throw InvalidArgument(list, "is no list");
    ordered_json& copies = bare[list] = ordered_json::array();
    for (const ordered_json& one : *all) {
      if (!one.is_object()) throw InvalidArgument(GltfItem(list, copies.size()), "is no object");
      ordered_json& copied = copies.emplace_back(ordered_json::object());
      for (const char* member : members)
        if (one.contains(member)) copied[member] = one[member];
    }
  };
  copy("nodes", {"name", "children", "translation", "rotation", "scale", "matrix"});
  copy("skins", {"joints"});
  const std::string json = bare.dump();
  return ParseGlb(JoinGlb({.json = json, .binary = {}, .others = {}}));
}

std::vector<bool> JointsOf(const tinygltf::Model& model) {
  std::vector<bool> joints(model.nodes.size(), model.skins.empty());
  for (const tinygltf::Skin& skin : model.skins) {
    for (const int joint : skin.joints) {
      GltfAt(model.nodes, joint, "skins.joints");
      joints[static_cast<size_t>(joint)] = true;
    }
  }
  return joints;
}

void RequireOneFile(const ordered_json& document) {
  const auto buffers = document.find("buffers");
  if (buffers == document.end() || !buffers->is_array() || buffers->empty()) return;
  if (!buffers->front().is_object()) throw InvalidArgument("buffers[0]", "is no object");
  if (buffers->front().contains("uri")) {
    throw InvalidArgument("buffers[0].uri",
                          "its data lie elsewhere; export the character as one file, glTF binary");
  }
}

}  // namespace

CharacterFile::CharacterFile(const std::filesystem::path& path) : path_(path) {
  try {
    bytes_ = ReadGlbBytes(path);
    const std::string_view text = SplitGlb(bytes_).json;
    CheckJsonDepth(text, "");
    const ordered_json document = ordered_json::parse(text, nullptr, false);
    if (!document.is_object())
      throw InvalidArgument("", "is no binary glTF: its JSON is no object");
    const tinygltf::Model model = ParseNodes(document);
    RequireOneFile(document);
    nodes_ = ReadGltfNodes(model);
    joints_ = JointsOf(model);
    vrm_ = FindHumanBones(VrmNames(document, nodes_.names.size()));
    places();  // is checked
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kNotFound) throw;
    throw Error(error.code(), path.string(), error.what());
  }
}

HumanBones CharacterFile::FindBones() const {
  if (MissingBone(vrm_).empty()) return vrm_;
  // A mesh is often called as the bone that it hangs on.
  std::vector<std::string> joints = nodes_.names;
  for (size_t node = 0; node < joints.size(); ++node) {
    if (!joints_[node]) joints[node].clear();
  }
  HumanBones found = FindHumanBones(joints);
  return MissingBone(found).empty() ? found : FindHumanBones(nodes_.names);
}

}  // namespace choreo
