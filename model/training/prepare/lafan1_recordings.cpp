#include <algorithm>
#include <map>
#include <regex>

#include "model/core/error.h"
#include "model/training/prepare/recordings.h"

namespace choreo {
namespace {

namespace fs = std::filesystem;

struct Take {
  fs::path path;
  std::string theme;
  int subject = 0;
};

/// Recordings by name.
std::map<std::string, Take> FindTakes(const fs::path& input) {
  static const std::regex kName("([A-Za-z]+)[0-9]+_subject([1-9])");
  std::map<std::string, Take> takes;
  for (const auto& entry : fs::directory_iterator(input)) {
    std::smatch parts;
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".bvh" || !std::regex_match(name, parts, kName)) continue;
    takes[name] = {entry.path(), parts[1], std::stoi(parts[2])};
  }
  if (takes.empty()) {
    throw Error(ErrorCode::kNotFound, input.string(),
                "no recording named as walk1_subject5.bvh, here in the folder itself");
  }
  return takes;
}

void CheckJoints(const PositionClip& clip, const std::string& file) {
  const auto& known = Lafan1JointNames();
  for (const std::string& name : known) {
    if (IndexOf(clip.joint_names, name) < 0) {
      throw InvalidArgument(file, "has no joint " + name + ", which LAFAN1 has");
    }
  }
  for (const std::string& name : clip.joint_names) {
    if (name.ends_with("_end") || std::ranges::find(known, name) != known.end()) continue;
    throw InvalidArgument(file, "has a joint " + name + ", which LAFAN1 has not");
  }
}

}  // namespace

const std::vector<std::string>& Lafan1JointNames() {
  static const std::vector<std::string> kNames = {
      "Hips",          "LeftUpLeg", "LeftLeg",      "LeftFoot", "LeftToe",     "RightUpLeg",
      "RightLeg",      "RightFoot", "RightToe",     "Spine",    "Spine1",      "Spine2",
      "Neck",          "Head",      "LeftShoulder", "LeftArm",  "LeftForeArm", "LeftHand",
      "RightShoulder", "RightArm",  "RightForeArm", "RightHand"};
  return kNames;
}

std::vector<RecordingSource> ListLafan1Recordings(const PrepareOptions& options) {
  std::vector<RecordingSource> sources;
  for (const auto& [name, take] : FindTakes(options.input)) {
    sources.push_back({name, [name = name, take = take, options] {
                         Recording recording = ReadBvhRecording(take.path, name, options);
                         CheckJoints(recording.positions, take.path.string());
                         recording.genre = take.theme;
                         return recording;
                       }});
  }
  return sources;
}

nlohmann::ordered_json Lafan1Splits(const PrepareOptions& options) {
  nlohmann::ordered_json parts = {{"train", nlohmann::json::array()},
                                  {"validation", nlohmann::json::array()},
                                  {"test", nlohmann::json::array()}};
  for (const auto& [name, take] : FindTakes(options.input)) {
    parts[take.subject == 5 ? "test" : take.subject == 4 ? "validation" : "train"].push_back(name);
  }
  return parts;
}

}  // namespace choreo
