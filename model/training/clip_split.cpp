#include "model/training/clip_split.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "model/core/error.h"

namespace choreo {
namespace {

using nlohmann::json;

// "train", "validation", "test...", or anything else ("unused") for a clip that the file names;
// nothing for one it does not.
std::optional<std::string> NamedSplit(const json& splits, const std::string& clip) {
  for (const auto& [set, parts] : splits.items()) {
    for (const auto& [part, names] : parts.items()) {
      if (std::find(names.begin(), names.end(), clip) != names.end()) return part;
    }
  }
  return std::nullopt;
}

bool Belongs(const std::optional<std::string>& part, Split split) {
  switch (split) {
    case Split::kTrain:
      return !part || *part == "train";
    case Split::kValidation:
      return part && *part == "validation";
    case Split::kTest:
      return part && *part == "test";
    case Split::kTrainAndValidation:
      return Belongs(part, Split::kTrain) || Belongs(part, Split::kValidation);
  }
  return false;
}

}  // namespace

std::vector<PreparedClip> LoadClips(const std::vector<std::filesystem::path>& folders,
                                    const std::filesystem::path& splits_file, Split split) {
  std::ifstream file(splits_file);
  if (!file) throw Error(ErrorCode::kNotFound, splits_file.string(), "no such splits file");
  const json splits = json::parse(file, nullptr, false);
  if (!splits.is_object()) throw InvalidArgument(splits_file.string(), "not a JSON object");
  std::vector<PreparedClip> clips;
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
      if (Belongs(NamedSplit(splits, clip.name), split)) clips.push_back(std::move(clip));
    }
  }
  if (clips.empty()) {
    throw InvalidArgument(splits_file.string(),
                          "no prepared clip of the data belongs to this split");
  }
  return clips;
}

}  // namespace choreo
