#include "client/cli/options/bone_map.h"

#include <algorithm>
#include <climits>
#include <nlohmann/json.hpp>

#include "client/authoring/fields/json_fields.h"
#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/text/printable.h"
#include "model/draw/bone_chart.h"
#include "model/fit/bones/character_body.h"
#include "model/fit/bones/guess_bones.h"

namespace choreo::cli {
namespace {

using nlohmann::json;

}  // namespace

std::vector<BoneChoice> ReadBoneMap(const std::filesystem::path& path) {
  const std::string name = path.string();
  const json file = authoring::ParseJson(authoring::ReadText(path, "map"), name);
  authoring::CheckFileMembers(file, name, {"bones"}, "bones");
  const auto bones = file.find("bones");
  if (bones == file.end() || !bones->is_object())
    throw InvalidArgument(name + ":bones", "must be an object, as in {\"pelvis\": \"Hips\"}");
  std::vector<BoneChoice> chosen;
  for (const auto& [bone, value] : bones->items()) {
    BoneChoice& choice = chosen.emplace_back();
    choice.bone = bone;
    choice.field = name + ":bones." + Printable(bone);
    if (value.is_number_unsigned()) {
      choice.node = static_cast<int>(std::min<uint64_t>(value.get<uint64_t>(), INT_MAX));
    } else if (value.is_string() && !value.get<std::string>().empty()) {
      choice.name = value.get<std::string>();
    } else if (!value.is_null()) {
      throw InvalidArgument(
          choice.field, authoring::Shown(value) + ", must be a node's name, its number or null");
    }
  }
  return chosen;
}

void WriteBoneMap(const std::filesystem::path& json_path, const std::filesystem::path& png,
                  const RigNodes& rig, const HumanBones& bones) {
  const std::vector<std::string>& names = rig.names;
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

  // The number of unassigned joints that fit beside the assigned ones, which are always drawn.
  size_t room = kMaxChartBones - static_cast<size_t>(std::ranges::count_if(
                                     means, [](const std::string& bone) { return !bone.empty(); }));
  std::vector<ChartBone> chart;
  std::vector<int> index(names.size(), -1);
  for (size_t node = 0; node < names.size(); ++node) {
    if (means[node].empty() && (!rig.joints[node] || room == 0)) continue;
    if (means[node].empty()) --room;
    index[node] = static_cast<int>(chart.size());
    chart.push_back({.name = names[node].empty() ? std::to_string(node) : names[node],
                     .place = rig.places.col(static_cast<Eigen::Index>(node)),
                     .parent = rig.parents[node],
                     .means = means[node]});
  }
  for (ChartBone& bone : chart)
    if (bone.parent >= 0) bone.parent = index[static_cast<size_t>(bone.parent)];
  if (!chart.empty()) DrawBoneChart(chart, png);
}

void SuggestBoneMap(const std::filesystem::path& out, const std::string& name, const RigNodes& rig,
                    HumanBones found) {
  RigNodes upright = rig;
  if (rig.names.empty()) throw InvalidArgument(name, "has no nodes");
  const std::string missing = MissingBones(found);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  const HumanBones guess = GuessBones(rig.parents, rig.places, rig.joints, &turn);
  upright.places = turn * rig.places;
  for (const auto& [bone, node] : guess.bones) {
    const bool taken =
        std::ranges::any_of(found.bones, [n = node](const auto& o) { return o.second == n; });
    if (!taken) found.bones.try_emplace(bone, node);
  }
  const std::filesystem::path stem = std::filesystem::path(out).replace_extension();
  const std::filesystem::path map = stem.string() + ".map.json",
                              picture = stem.string() + ".map.png";
  if (std::filesystem::exists(map)) {
    throw InvalidArgument(name, "its names do not say which bone is the " + missing + "; " +
                                    map.string() + " is there already: --map it, or remove it");
  }
  WriteBoneMap(map, picture, upright, found);
  throw InvalidArgument(name, "its names do not say which bone is the " + missing + "; " +
                                  map.string() + " is a guess, " + picture.string() +
                                  " a picture: correct the guess with it, then --map " +
                                  map.string());
}

}  // namespace choreo::cli
