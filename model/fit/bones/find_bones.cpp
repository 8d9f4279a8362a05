#include "model/fit/bones/find_bones.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "model/core/joined.h"
#include "model/core/text/printable.h"
#include "model/fit/bones/character_body.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

constexpr size_t kMaxGroups = 16, kMaxRigNodes = 5000;  // limits for hostile files
constexpr size_t kMinBones = 12, kMaxBodies = 8;
// Bones counted by `Needed`: six on each side, and the head or the neck.
constexpr int kAllNeeded = 2 * static_cast<int>(std::size(kNeededLimbBones)) + 1;

std::string Quote(const std::string& name) { return '"' + Printable(name) + '"'; }

/// Nodes that may form one body.
using Group = std::vector<bool>;

Group Below(const RigNodes& rig, int top) {
  Group group(rig.names.size());
  for (size_t node = 0; node < group.size(); ++node)
    group[node] = IsBelow(static_cast<int>(node), top, rig.parents);
  return group;
}

// The nodes with enough descendants for a body, those near the root first: whole skeletons.
std::vector<int> TopsOf(const RigNodes& rig) {
  std::vector<int> tops;
  if (rig.names.size() > kMaxRigNodes) return tops;
  std::vector<int> carried(rig.names.size(), 0), depth(rig.names.size(), 0);
  for (size_t node = 0; node < rig.names.size(); ++node) {
    for (int above = static_cast<int>(node); above >= 0; above = rig.parents[above]) {
      ++carried[above];
      if (above != static_cast<int>(node)) ++depth[node];
    }
  }
  for (size_t node = 0; node < rig.names.size(); ++node) {
    if (carried[node] >= static_cast<int>(kMinBones)) tops.push_back(static_cast<int>(node));
  }
  std::ranges::stable_sort(tops, {}, [&](int node) { return depth[node]; });
  return tops;
}

// The names of a group's nodes. Of nodes with the same name, keeps the one most like a bone.
std::vector<std::string> NamesOf(const RigNodes& rig, const Group& group) {
  const auto rank = [&](int node) {
    const bool carries = std::ranges::find(rig.parents, node) != rig.parents.end();
    return std::tuple(rig.joints[node], rig.moves[node], !rig.meshes[node], carries);
  };
  std::map<std::string_view, int> best;
  for (size_t node = 0; node < group.size(); ++node) {
    if (!group[node] || rig.names[node].empty()) continue;
    const auto [at, is_new] = best.try_emplace(rig.names[node], static_cast<int>(node));
    if (!is_new && rank(static_cast<int>(node)) > rank(at->second))
      at->second = static_cast<int>(node);
  }
  std::vector<std::string> names(rig.names.size());
  for (const auto& [name, node] : best) names[node] = name;
  return names;
}

int Needed(const HumanBones& found) {
  int needed = found.Find("head") >= 0 || found.Find("neck") >= 0 ? 1 : 0;
  for (const char* side : {"left_", "right_"}) {
    for (const char* bone : kNeededLimbBones)
      needed += found.Find(std::string(side) + bone) >= 0 ? 1 : 0;
  }
  return needed;
}

// Counts the body's bones among `nodes`.
int Count(const HumanBones& found, const std::vector<bool>& nodes) {
  return static_cast<int>(
      std::ranges::count_if(found.bones, [&](const auto& bone) { return nodes[bone.second]; }));
}

// Counts the bones that descend from the bone above them in a body, such as knees from hips.
int Connected(const RigNodes& rig, const HumanBones& found) {
  int connected = 0;
  const auto add = [&](const std::string& bone, const std::string& above) {
    const int node = found.Find(bone), ancestor = found.Find(above);
    connected += node >= 0 && ancestor >= 0 && IsBelow(node, ancestor, rig.parents) ? 1 : 0;
  };
  add("neck", "pelvis");
  add("head", found.Find("neck") >= 0 ? "neck" : "pelvis");
  for (const std::string side : {"left_", "right_"}) {
    add(side + "hip", "pelvis");
    add(side + "knee", side + "hip");
    add(side + "ankle", side + "knee");
    add(side + "foot", side + "ankle");
    add(side + "collar", "pelvis");
    add(side + "shoulder", found.Find(side + "collar") >= 0 ? side + "collar" : "pelvis");
    add(side + "elbow", side + "shoulder");
    add(side + "wrist", side + "elbow");
  }
  return connected;
}

// Hips hang from the pelvis, whatever its name.
void FindPelvis(const RigNodes& rig, HumanBones* found) {
  const int left = found->Find("left_hip"), right = found->Find("right_hip");
  if (found->Find("pelvis") >= 0 || left < 0 || right < 0) return;
  int node = rig.parents[left];
  while (node >= 0 && !IsBelow(right, node, rig.parents)) node = rig.parents[node];
  const bool taken =
      std::ranges::any_of(found->bones, [&](const auto& b) { return b.second == node; });
  if (node >= 0 && !taken) found->bones["pelvis"] = node;
}

// The node above both arms is the chest, the last bone of the spine, whatever its name.
void FindChest(const RigNodes& rig, HumanBones* found) {
  const auto arm = [&](const std::string& side) {
    const int collar = found->Find(side + "collar");
    return collar >= 0 ? collar : found->Find(side + "shoulder");
  };
  const int left = arm("left_"), right = arm("right_"), pelvis = found->Find("pelvis");
  if (left < 0 || right < 0 || pelvis < 0) return;
  int chest = rig.parents[left];
  while (chest >= 0 && !IsBelow(right, chest, rig.parents)) chest = rig.parents[chest];
  const std::vector<std::string> spine = found->Spine();
  const int last = spine.empty() ? pelvis : found->Find(spine.back());
  const std::string next = "spine" + std::to_string(spine.size() + 1);
  const bool taken =
      std::ranges::any_of(found->bones, [&](const auto& bone) { return bone.second == chest; });
  const std::vector<std::string>& all = AllHumanBones();
  if (chest >= 0 && !taken && IsBelow(chest, last, rig.parents) &&
      std::ranges::find(all, next) != all.end())
    found->bones[next] = chest;
}

// Finds a body by names among all nodes, then among the descendants of each node. A file may have
// several bodies with the same names; the one that moves counts.
HumanBones ByNames(const RigNodes& rig) {
  const auto score = [&](const HumanBones& found) {
    return std::tuple(Needed(found), Count(found, rig.moves), Count(found, rig.joints),
                      Connected(rig, found), static_cast<int>(found.bones.size()));
  };
  HumanBones best = FindHumanBones(NamesOf(rig, Group(rig.names.size(), true)), rig.moves);
  size_t looked_at = 0;
  std::vector<int> partial;  // neither these nor their descendants have a whole body below them
  for (const int top : TopsOf(rig)) {
    const bool below =
        std::ranges::any_of(partial, [&](int node) { return IsBelow(top, node, rig.parents); });
    if (below) continue;
    if (++looked_at > kMaxGroups) break;
    HumanBones found = FindHumanBones(NamesOf(rig, Below(rig, top)), rig.moves);
    if (Needed(found) < kAllNeeded) partial.push_back(top);
    if (score(found) > score(best)) best = std::move(found);
  }
  return best;
}

void Choose(const RigNodes& rig, const BoneChoice& choice, HumanBones* found) {
  const std::vector<std::string>& known = AllHumanBones();
  if (std::ranges::find(known, choice.bone) == known.end())
    throw InvalidArgument(choice.field, "is none of " + Joined(known));
  found->bones.erase(choice.bone);
  const auto count = static_cast<int>(rig.names.size());
  if (choice.name.empty()) {
    if (choice.node >= count) {
      throw InvalidArgument(choice.field, std::to_string(choice.node) +
                                              ", must be a name or a number below " +
                                              std::to_string(count) + ", of its nodes");
    }
    if (choice.node >= 0) found->bones[choice.bone] = choice.node;
    return;
  }
  std::vector<int> nodes, joints;
  for (int node = 0; node < count; ++node) {
    if (rig.names[node] != choice.name) continue;
    nodes.push_back(node);
    // A mesh often has the name of the joint above it.
    if (rig.joints[node] && !rig.meshes[node]) joints.push_back(node);
  }
  if (nodes.empty())
    throw InvalidArgument(choice.field, Quote(choice.name) + " is none of its nodes");
  if (nodes.size() > 1 && joints.size() != 1) {
    throw InvalidArgument(choice.field,
                          Quote(choice.name) + " names several nodes: give its number, from 0 on");
  }
  found->bones[choice.bone] = nodes.size() > 1 ? joints.front() : nodes.front();
}

}  // namespace

HumanBones FindBones(const RigNodes& rig, const std::vector<BoneChoice>& chosen) {
  HumanBones found = rig.table;
  if (!MissingBones(found).empty()) {
    found = ByNames(rig);
    // A table that lacks some bones still identifies the others better than names do.
    for (const auto& [bone, node] : rig.table.bones) {
      std::erase_if(found.bones, [n = node](const auto& other) { return other.second == n; });
      found.bones[bone] = node;
    }
  }
  for (const BoneChoice& choice : chosen) Choose(rig, choice, &found);
  const bool says_pelvis =
      std::ranges::any_of(chosen, [](const auto& choice) { return choice.bone == "pelvis"; });
  if (!says_pelvis) FindPelvis(rig, &found);
  const bool says_spine = std::ranges::any_of(
      chosen, [](const auto& choice) { return choice.bone.starts_with("spine"); });
  if (!says_spine) FindChest(rig, &found);
  return found;
}

std::vector<HumanBones> MovingBodies(const RigNodes& rig, const HumanBones& found) {
  std::vector<HumanBones> bodies = {found};
  if (rig.names.size() > kMaxRigNodes) return bodies;
  RigNodes rest = rig;
  while (bodies.size() < kMaxBodies && !bodies.back().bones.empty()) {
    // Skip the skeleton already found.
    int top = bodies.back().bones.begin()->second;
    for (const auto& [bone, node] : bodies.back().bones) {
      while (top >= 0 && !IsBelow(node, top, rig.parents)) top = rig.parents[top];
    }
    for (size_t node = 0; node < rest.names.size(); ++node) {
      if (top < 0 || IsBelow(static_cast<int>(node), top, rig.parents)) rest.names[node].clear();
    }
    HumanBones next = ByNames(rest);
    if (Needed(next) < Needed(found) || 2 * Count(next, rig.moves) < Count(found, rig.moves)) break;
    FindPelvis(rig, &next);
    FindChest(rig, &next);
    bodies.push_back(std::move(next));
  }
  std::ranges::stable_sort(bodies, {}, [](const HumanBones& body) {
    return body.bones.empty() ? -1 : body.Find("left_hip");
  });
  return bodies;
}

UnknownBones::UnknownBones(const std::string& field, const std::string& missing, RigNodes rig,
                           HumanBones found)
    : Error(ErrorCode::kInvalidArgument, field,
            "its names do not say which bone is the " + missing +
                "; choreo convert writes a guess and a picture, and takes --map"),
      rig_(std::move(rig)),
      found_(std::move(found)),
      missing_(missing) {}

}  // namespace choreo
