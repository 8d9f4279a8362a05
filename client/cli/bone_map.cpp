#include "client/cli/bone_map.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "client/cli/json_fields.h"
#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/core/printable.h"
#include "model/draw/bone_chart.h"

namespace choreo::cli {
namespace {

using nlohmann::json;

std::string Quoted(const std::string& name) { return '"' + Printable(name) + '"'; }

int FindNode(const json& value, const std::string& field, const CharacterFile& character) {
  const std::vector<std::string>& names = character.nodes().names;
  if (value.is_number_unsigned()) {
    const auto node = value.get<uint64_t>();
    if (node < names.size()) return static_cast<int>(node);
    throw InvalidArgument(field, std::to_string(node) + ", must be a name or a number below " +
                                     std::to_string(names.size()) + ", of its nodes");
  }
  if (!value.is_string())
    throw InvalidArgument(field, Shown(value) + ", must be a node's name, its number or null");
  const auto name = value.get<std::string>();
  const auto first = std::ranges::find(names, name);
  if (name.empty() || first == names.end())
    throw InvalidArgument(field, Quoted(name) + " is none of the character's nodes");
  if (std::ranges::count(names, name) > 1) {
    // A mesh is often called as the joint that it hangs on.
    std::vector<int> joints;
    for (size_t node = 0; node < names.size(); ++node) {
      if (names[node] == name && character.joints()[node]) joints.push_back(static_cast<int>(node));
    }
    if (joints.size() == 1) return joints.front();
    throw InvalidArgument(field, Quoted(name) + " names several nodes: give its number, from 0 on");
  }
  return static_cast<int>(first - names.begin());
}

}  // namespace

HumanBones ReadBoneMap(const std::filesystem::path& path, const CharacterFile& character,
                       HumanBones found) {
  const std::string name = path.string();
  const json file = ParseJson(ReadText(path, "map"), name);
  CheckFileMembers(file, name, {"bones"}, "bones");
  const auto bones = file.find("bones");
  if (bones == file.end() || !bones->is_object())
    throw InvalidArgument(name + ":bones", "must be an object, as in {\"pelvis\": \"Hips\"}");
  const std::vector<std::string>& known = AllHumanBones();
  for (const auto& [bone, value] : bones->items()) {
    const std::string field = name + ":bones." + Printable(bone);
    if (std::ranges::find(known, bone) == known.end()) {
      std::string all;
      for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
      throw InvalidArgument(field, "is none of " + all);
    }
    found.bones.erase(bone);
    if (!value.is_null()) found.bones[bone] = FindNode(value, field, character);
  }
  return found;
}

void WriteBoneMap(const std::filesystem::path& json_path, const std::filesystem::path& png,
                  const CharacterFile& character, const HumanBones& bones) {
  const std::vector<std::string>& names = character.nodes().names;
  nlohmann::ordered_json map;
  std::vector<std::string> means(names.size());
  for (const std::string& bone : AllHumanBones()) {
    const int node = bones.Find(bone);
    nlohmann::ordered_json& entry = map["bones"][bone] = nullptr;
    if (node < 0) continue;
    const std::string& name = names[static_cast<size_t>(node)];
    means[static_cast<size_t>(node)] = bone;
    if (name.empty() || std::ranges::count(names, name) > 1) {
      entry = node;
    } else {
      entry = name;
    }
  }
  WriteFile(json_path, map.dump(2) + "\n");

  // Those that are taken for something in any case.
  size_t room =
      kMostChartBones - static_cast<size_t>(std::ranges::count_if(
                            means, [](const std::string& bone) { return !bone.empty(); }));
  const Eigen::Matrix3Xd places = character.places();
  std::vector<ChartBone> chart;
  std::vector<int> index(names.size(), -1);
  for (size_t node = 0; node < names.size(); ++node) {
    if (means[node].empty() && (!character.joints()[node] || room == 0)) continue;
    if (means[node].empty()) --room;
    index[node] = static_cast<int>(chart.size());
    chart.push_back({.name = names[node].empty() ? std::to_string(node) : names[node],
                     .place = places.col(static_cast<Eigen::Index>(node)),
                     .parent = character.nodes().parents[node],
                     .means = means[node]});
  }
  for (ChartBone& bone : chart)
    if (bone.parent >= 0) bone.parent = index[static_cast<size_t>(bone.parent)];
  if (!chart.empty()) DrawBoneChart(chart, png);
}

}  // namespace choreo::cli
