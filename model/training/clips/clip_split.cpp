#include "model/training/clips/clip_split.h"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "model/core/error.h"

namespace choreo {
namespace {

using nlohmann::json;

// The group of each clip, set by set. A clip in two groups could be both trained and tested on.
using Groups = std::map<std::string, std::map<std::string, std::string>>;

Groups ReadGroups(const std::filesystem::path& splits_file) {
  std::ifstream file(splits_file);
  if (!file) throw Error(ErrorCode::kNotFound, splits_file.string(), "no such splits file");
  const json splits = json::parse(file, nullptr, false);
  if (!splits.is_object()) throw InvalidArgument(splits_file.string(), "not a JSON object");
  Groups groups;
  for (const auto& [set, parts] : splits.items()) {
    for (const auto& [group, names] : parts.items()) {
      for (const json& name : names) {
        if (!name.is_string()) continue;
        const auto [known, added] = groups[set].emplace(name.get<std::string>(), group);
        if (added || known->second == group) continue;
        throw InvalidArgument(splits_file.string(), "'" + known->first + "' is both in '" +
                                                        known->second + "' and in '" + group + "'");
      }
    }
  }
  return groups;
}

// Finds a clip's group. If two sets share clip names, a folder's clips belong to the set with the
// folder's name.
std::string GroupOf(const Groups& groups, const std::filesystem::path& folder,
                    const std::string& clip, const std::filesystem::path& splits_file) {
  std::optional<std::string> found;
  const auto own = groups.find(folder.filename().string());
  for (const auto& [set, names] : groups) {
    if (own != groups.end() && set != own->first) continue;
    const auto named = names.find(clip);
    if (named == names.end()) continue;
    if (found && *found != named->second) {
      throw InvalidArgument(splits_file.string(),
                            "'" + clip + "' is both in '" + *found + "' and in '" + named->second +
                                "', and no set is called as the folder " + folder.string());
    }
    found = named->second;
  }
  return found.value_or(kTrainGroup);
}

// "'a', 'b'"
std::string Quote(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

}  // namespace

std::vector<PreparedClip> LoadClips(const std::vector<std::filesystem::path>& folders,
                                    const std::filesystem::path& splits_file,
                                    const std::string& requested) {
  const Groups groups = ReadGroups(splits_file);
  std::vector<PreparedClip> clips;
  std::set<std::string> there;
  std::optional<std::pair<std::filesystem::path, Skeleton>> first;
  for (const auto& folder : folders) {
    for (const auto& path : ListPreparedClips(folder)) {
      PreparedClip clip = ReadPreparedClip(path);
      if (!first) first.emplace(path, clip.skeleton);
      if (!(clip.skeleton == first->second)) {
        throw InvalidArgument(path.string(),
                              "its skeleton is " + clip.skeleton.Describe() + ", that of " +
                                  first->first.string() + " " + first->second.Describe() +
                                  "; a model has one skeleton, bone lengths included");
      }
      const std::string& group =
          *there.insert(GroupOf(groups, folder, clip.name, splits_file)).first;
      if (group == requested) clips.push_back(std::move(clip));
    }
  }
  if (clips.empty()) {
    std::set<std::string> data;
    for (const auto& folder : folders) data.insert(folder.string());
    throw InvalidArgument(splits_file.string(), "no clip of " + Quote(data) + " is in '" +
                                                    requested + "'; they are in " + Quote(there));
  }
  return clips;
}

}  // namespace choreo
