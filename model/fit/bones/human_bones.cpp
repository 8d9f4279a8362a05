#include "model/fit/bones/human_bones.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "model/fit/bones/human_rigs.h"

namespace choreo {
namespace {

constexpr int kMaxSpines = 6, kMaxNecks = 3;
constexpr int kMaxEnds = 4;  // "_bind_jnt" has two; a limit for hostile files

std::vector<std::string_view> Split(std::string_view names) {
  std::vector<std::string_view> out;
  while (!names.empty()) {
    const size_t end = std::min(names.find('|'), names.size());
    out.push_back(names.substr(0, end));
    names.remove_prefix(std::min(end + 1, names.size()));
  }
  return out;
}

// A name of the table for one side. Names of middle bones stay as they are.
std::string OnSide(std::string_view name, const Rig& rig, bool left) {
  std::string out;
  for (const char letter : name) {
    if (letter == '*') {
      out += rig.side_names[left ? 0 : 1];
    } else if (letter == '@') {
      out += left ? "left" : "right";
    } else {
      out += letter;
    }
  }
  return out;
}

std::string SpineName(int number) { return "spine" + std::to_string(number); }
std::string NeckName(int number) { return number == 1 ? "neck" : "neck" + std::to_string(number); }

using NameIndex = std::unordered_map<std::string_view, int>;

enum class Spelling { kExact, kPlain };

// Normalises tools' spellings: no separators, lower case.
std::string Plain(const std::string& name) {
  std::string plain;
  for (const char letter : name) {
    if (std::string_view("_.-:| ").find(letter) != std::string_view::npos) continue;
    plain += letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  }
  return plain;
}

// Removes the number that makes a name unique, such as in "Hips_012" or "Hips.001".
std::string WithoutNumber(const std::string& name) {
  const size_t last = name.find_last_not_of("0123456789");
  if (last == std::string::npos || last + 1 == name.size() || last == 0) return name;
  return name[last] == '_' || name[last] == '.' ? name.substr(0, last) : name;
}

HumanBones FindIn(const Rig& rig, const std::string& prefix, const NameIndex& names,
                  Spelling spelling) {
  HumanBones found{.rig = rig.name, .bones = {}};
  const auto at = [&](const std::string& name) {
    return names.find(prefix + (spelling == Spelling::kPlain ? Plain(name) : name));
  };
  const auto any = [&](const std::string& bone, std::string_view candidates, bool left) {
    for (const std::string_view candidate : Split(candidates)) {
      const auto name = at(OnSide(candidate, rig, left));
      if (name != names.end() && found.bones.try_emplace(bone, name->second).second) return;
    }
  };
  const auto all = [&](std::string (*bone)(int), std::string_view candidates) {
    int number = 0;
    for (const std::string_view candidate : Split(candidates)) {
      const auto name = at(std::string(candidate));
      if (name != names.end()) found.bones[bone(++number)] = name->second;
    }
  };
  any("pelvis", rig.trunk.pelvis, true);
  any("head", rig.trunk.head, true);
  all(SpineName, rig.trunk.spine);
  all(NeckName, rig.trunk.neck);
  for (const bool left : {true, false}) {
    for (size_t i = 0; i < std::size(kLimbBones); ++i)
      any((left ? "left_" : "right_") + std::string(kLimbBones[i]), rig.limbs[i], left);
  }
  return found;
}

// Whether this may precede all names of a rig: nothing, or text that ends in a separator.
bool IsPrefix(std::string_view prefix) {
  return prefix.empty() || prefix.starts_with("mixamorig") ||
         std::string_view(":_-|. ").find(prefix.back()) != std::string_view::npos;
}

// Prefixes under which the left thigh exists. Rigify's DEF- bones move the mesh.
std::vector<std::string> PrefixesOf(const Rig& rig, const std::vector<std::string>& names,
                                    Spelling spelling) {
  constexpr size_t kMaxPrefixes = 8;  // a limit for hostile files
  const bool plain = spelling == Spelling::kPlain;
  std::vector<std::string> prefixes = {"", plain ? "def" : "DEF-"};
  for (const std::string_view candidate : Split(rig.limbs[0])) {
    std::string thigh = OnSide(candidate, rig, true);
    if (plain) thigh = Plain(thigh);
    for (const std::string& name : names) {
      if (!name.ends_with(thigh) || prefixes.size() == kMaxPrefixes) continue;
      std::string prefix = name.substr(0, name.size() - thigh.size());
      if ((plain || IsPrefix(prefix)) && std::ranges::find(prefixes, prefix) == prefixes.end())
        prefixes.push_back(std::move(prefix));
    }
  }
  return prefixes;
}

// Removes the common ending of most names, as in "LeftArm_jnt" or "l_arm_bind_jnt", unless it is a
// side.
std::vector<std::string> WithoutCommonEnd(std::vector<std::string> names) {
  const auto end_of = [](const std::string& name) {
    const size_t at = name.find_last_of("_.-:| ");
    return at == std::string::npos || at == 0 ? std::string() : name.substr(at);
  };
  for (int ends = 0; ends < kMaxEnds; ++ends) {
    std::map<std::string, size_t> times;
    for (const std::string& name : names) {
      if (const std::string end = end_of(name); !end.empty()) ++times[end];
    }
    const auto most = std::ranges::max_element(times, {}, [](const auto& e) { return e.second; });
    if (most == times.end() || 2 * most->second <= names.size()) return names;
    for (std::string& name : names) {
      if (end_of(name) == most->first) name.resize(name.size() - most->first.size());
    }
  }
  return names;
}

// The score of a rig: first the bones that dancing needs, then those that move, then all others.
std::tuple<int, size_t, size_t> Score(const HumanBones& found,
                                      const std::vector<bool>& moves = {}) {
  int needed = found.Find("head") >= 0 || found.Find("neck") >= 0 ? 1 : 0;
  for (const char* side : {"left_", "right_"}) {
    for (const char* bone : kNeededLimbBones)
      needed += found.Find(std::string(side) + bone) >= 0 ? 1 : 0;
  }
  const auto moving = std::ranges::count_if(found.bones, [&](const auto& bone) {
    return static_cast<size_t>(bone.second) < moves.size() && moves[bone.second];
  });
  return {needed, static_cast<size_t>(moving), found.bones.size()};
}

bool IsWhole(const HumanBones& found) {
  return std::get<0>(Score(found)) > 2 * static_cast<int>(std::size(kNeededLimbBones));
}

HumanBones FindSpelt(const std::vector<std::string>& names, Spelling spelling,
                     const std::vector<bool>& moves) {
  NameIndex index;  // the first of each name
  for (size_t i = 0; i < names.size(); ++i) index.try_emplace(names[i], static_cast<int>(i));
  HumanBones best{.rig = kHumanIkRig, .bones = {}};
  for (const Rig& rig : kRigs) {
    for (const std::string& prefix : PrefixesOf(rig, names, spelling)) {
      HumanBones found = FindIn(rig, prefix, index, spelling);
      if (Score(found, moves) > Score(best, moves)) best = std::move(found);
    }
  }
  return best;
}

std::vector<std::string> Chain(const HumanBones& found, std::string (*bone)(int)) {
  std::vector<std::string> chain;
  for (int number = 1; found.Find(bone(number)) >= 0; ++number) chain.push_back(bone(number));
  return chain;
}

}  // namespace

int HumanBones::Find(const std::string& bone) const {
  const auto found = bones.find(bone);
  return found == bones.end() ? -1 : found->second;
}

std::vector<std::string> HumanBones::Spine() const { return Chain(*this, SpineName); }
std::vector<std::string> HumanBones::Neck() const { return Chain(*this, NeckName); }

HumanBones FindHumanBones(const std::vector<std::string>& names, const std::vector<bool>& moves) {
  HumanBones best = FindSpelt(names, Spelling::kExact, moves);
  if (IsWhole(best) || names.empty()) return best;
  // Another spelling counts only if it gives a whole body.
  const auto each = [](std::vector<std::string> all, auto change) {
    for (std::string& name : all) name = change(name);
    return all;
  };
  const std::vector<std::string> unnumbered = each(names, WithoutNumber);
  for (const std::vector<std::string>& respelt :
       {unnumbered, WithoutCommonEnd(names), WithoutCommonEnd(unnumbered)}) {
    HumanBones found = FindSpelt(respelt, Spelling::kExact, moves);
    if (IsWhole(found)) return found;
  }
  for (const std::vector<std::string>& respelt :
       {names, unnumbered, WithoutCommonEnd(names), WithoutCommonEnd(unnumbered)}) {
    HumanBones found = FindSpelt(each(respelt, Plain), Spelling::kPlain, moves);
    if (IsWhole(found)) return found;
  }
  return best;
}

const std::vector<std::string>& AllHumanBones() {
  static const std::vector<std::string> bones = [] {
    std::vector<std::string> all = {"pelvis"};
    for (int number = 1; number <= kMaxSpines; ++number) all.push_back(SpineName(number));
    for (int number = 1; number <= kMaxNecks; ++number) all.push_back(NeckName(number));
    all.emplace_back("head");
    for (const char* side : {"left_", "right_"}) {
      for (const std::string_view bone : kLimbBones) all.push_back(side + std::string(bone));
    }
    return all;
  }();
  return bones;
}

std::vector<std::string_view> AllRigNames() {
  std::vector<std::string_view> names;
  for (const Rig& rig : kRigs) names.push_back(rig.name);
  return names;
}

std::string NameInRig(std::string_view rig_name, const std::string& bone) {
  const Rig& rig = *std::ranges::find(kRigs, rig_name, &Rig::name);
  const auto nth = [](std::string_view names, int number) {
    const std::vector<std::string_view> split = Split(names);
    return number > std::ssize(split) ? std::string() : std::string(split[number - 1]);
  };
  for (int number = 1; number <= kMaxSpines; ++number) {
    if (bone == SpineName(number)) return nth(rig.trunk.spine, number);
    if (bone == NeckName(number)) return nth(rig.trunk.neck, number);
  }
  if (bone == "pelvis") return nth(rig.trunk.pelvis, 1);
  if (bone == "head") return nth(rig.trunk.head, 1);
  const bool left = bone.starts_with("left_");
  for (size_t i = 0; i < std::size(kLimbBones); ++i) {
    if (bone == (left ? "left_" : "right_") + std::string(kLimbBones[i]))
      return OnSide(nth(rig.limbs[i], 1), rig, left);
  }
  return "";
}

}  // namespace choreo
