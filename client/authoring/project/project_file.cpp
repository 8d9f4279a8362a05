#include "client/authoring/project/project_file.h"

#include <algorithm>
#include <sstream>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/music/beat_options.h"
#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/core/rounded.h"
#include "model/motion/controls/velocity_factors.h"

namespace choreo::authoring {
namespace {

using nlohmann::json;

std::string Text(const json& file, const std::string& name, const char* member) {
  if (!file.contains(member)) return {};
  if (!file[member].is_string())
    throw InvalidArgument(name + ":" + member, Shown(file[member]) + " is not a text");
  return file[member].get<std::string>();
}

std::optional<double> NumberIn(const json& file, const std::string& name, const char* member) {
  if (!file.contains(member)) return std::nullopt;
  return JsonNumber(file[member], name + ":" + member);
}

/// Reads a setting of the manner if the project states it.
struct SettingReader {
  const json& file;
  const std::string& name;

  void operator()(const SettingRow& row, std::string& text) const {
    text = Text(file, name, row.name);
  }
  void operator()(const SettingRow& row, std::optional<double>& number) const {
    number = NumberIn(file, name, row.name);
  }
};

bool IsCount(const json& value) {
  return IsFrameNumber(value) && value.get<uint64_t>() >= 1 &&
         value.get<uint64_t>() <= kMaxBeatsInBar;
}

/// Reads beats, [[0.52, 1], [1.02, 2], ...]: seconds and counts.
void ReadBeats(const json& list, int bar, const std::string& name, Project* project) {
  if (!list.is_array()) throw InvalidArgument(name + ":beats", Shown(list) + " is not a list");
  std::vector<double> seconds;
  std::vector<int> counts;
  for (const json& beat : list) {
    const std::string at = name + ":beats[" + std::to_string(seconds.size()) + "]";
    if (!beat.is_array() || beat.size() != 2 || !IsCount(beat[1])) {
      throw InvalidArgument(at, Shown(beat) + " is not a beat: its second and its count, 1 to " +
                                    std::to_string(kMaxBeatsInBar) + ", as in [12.5, 1]");
    }
    seconds.push_back(JsonNumber(beat[0], at));
    counts.push_back(beat[1].get<int>());
  }
  project->SetBeats(std::move(seconds), std::move(counts), bar, name);
}

const json& Object(const json& value, const std::string& field) {
  if (!value.is_object()) throw InvalidArgument(field, Shown(value) + " is not an object");
  return value;
}

/// Converts the velocity factors of older projects. Returns null if all parts have the usual
/// factor.
json FactorsIn(const json& parts, const std::string& field) {
  json out;
  bool as_usual = true;
  for (const auto& [member, value] : Object(parts, field).items()) {
    std::string part = member;
    std::ranges::replace(part, ' ', '_');
    const auto named = std::ranges::find(kBodyPartNames, part);
    if (named == kBodyPartNames.end())
      throw InvalidArgument(field + "." + member, "is none of " + BodyPartNames());
    const double factor = JsonNumber(value, field + "." + member);
    if (!(factor >= 0 && factor <= kMaxVelocityFactor)) {
      std::ostringstream message;
      message << Shown(value) << " is not a number from 0 to " << kMaxVelocityFactor;
      throw InvalidArgument(field + "." + member, message.str());
    }
    as_usual = as_usual && factor == 1;
    out["parts"].push_back(part);
    out["factors"].push_back(factor);
  }
  return as_usual ? json() : out;
}

void ReadControls(const json& file, const std::string& name, std::span<const ControlRow> rows,
                  WrittenControls* controls) {
  const auto take = [controls](std::string_view control, const json& value,
                               const std::string& field) {
    (*controls)[control].project = value;
    (*controls)[control].project_name = field;
  };
  if (const std::string field = name + ":lively"; file.contains("lively"))
    take(kControls[kVelocityFactors].name, FactorsIn(file["lively"], field), field);
  if (const std::string field = name + ":path"; file.contains("path"))
    take(kControls[kRootPath].name, Object(file["path"], field), field);
  if (!file.contains("controls")) return;
  for (const auto& [control, value] : Object(file["controls"], name + ":controls").items()) {
    const std::string field = name + ":controls." + control;
    if (std::ranges::find(rows, control, &ControlRow::name) == rows.end())
      throw InvalidArgument(field, "is none of " + Joined(rows, &ControlRow::name));
    take(control, Object(value, field), field);
  }
}

/// Reads markers, which are only for people.
std::vector<Marker> MarkersIn(const json& list, const std::string& field) {
  if (!list.is_array()) throw InvalidArgument(field, Shown(list) + " is not a list");
  std::vector<Marker> markers;
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string at = field + "[" + std::to_string(i) + "]";
    CheckMembers(list[i], at, {"time", "name"}, "a marker has time and name");
    for (const char* member : {"time", "name"})
      if (!list[i].contains(member)) throw InvalidArgument(at + "." + member, "is missing");
    markers.push_back({JsonNumber(list[i]["time"], at + ".time"), Text(list[i], at, "name")});
  }
  return markers;
}

void CheckMarkers(const std::vector<Marker>& markers, const std::string& field) {
  double before = -1;
  for (size_t i = 0; i < markers.size(); ++i) {
    const std::string at = field + "[" + std::to_string(i) + "]";
    const auto& [time, marked] = markers[i];
    if (marked.empty()) throw InvalidArgument(at + ".name", "is empty");
    if (!(time > before && time <= kMaxDanceSeconds)) {
      throw InvalidArgument(
          at + ".time",
          InFull(time) + " is not above the one before it and up to " + InFull(kMaxDanceSeconds));
    }
    before = time;
  }
}

}  // namespace

Project ParseProject(const json& file, const std::string& name, std::span<const ControlRow> rows) {
  const bool has_no_keys = file.is_object() && file.contains("keyframes") &&
                           file["keyframes"] == nlohmann::json::array();
  if (!has_no_keys) ListIn(file, name, "keyframes");  // its error suggests other kinds of file
  if (!file.contains("studio"))
    throw InvalidArgument(
        name + ":studio",
        "is missing: a project says \"studio\": 1; a key file goes with choreo dance --keyframes");
  if (file["studio"] != kProjectFormat) {
    throw InvalidArgument(name + ":studio", "is format " + Shown(file["studio"]) + ", known is " +
                                                std::to_string(kProjectFormat));
  }
  // song_data: only in the studio's messages, which contain the song (studio/project_calls).
  CheckFileMembers(
      file, name,
      {"studio", "song", "song_data", "seconds", "seed", "style", "music_dynamics", "variation",
       "beats", "bar", "controls", "lively", "path", "markers", "dancers", "apart", "keyframes",
       "about"},
      "a project has studio, song, seconds, seed, style, music_dynamics, variation, "
      "beats, bar, controls, lively, path, markers, dancers, apart, keyframes and perhaps about");
  Project project;
  project.has_keys = !has_no_keys;
  project.song = Text(file, name, "song");
  DanceManner::VisitSettings(SettingReader{file, name}, project);
  project.seconds = NumberIn(file, name, "seconds");
  if (file.contains("seed")) {
    if (!file["seed"].is_number_unsigned())
      throw InvalidArgument(name + ":seed",
                            Shown(file["seed"]) + " is not a whole number from 0 on");
    project.seed = file["seed"].get<uint64_t>();
  }
  if (file.contains("bar") && !IsCount(file["bar"])) {
    throw InvalidArgument(name + ":bar", Shown(file["bar"]) + " is not a whole number from 1 to " +
                                             std::to_string(kMaxBeatsInBar));
  }
  if (file.contains("beats"))
    ReadBeats(file["beats"], file.value("bar", kDefaultBar), name, &project);
  ReadControls(file, name, rows, &project.controls);
  if (file.contains("markers")) project.markers = MarkersIn(file["markers"], name + ":markers");
  project.has_dancers = file.contains("dancers");
  CheckProject(project, name);
  return project;
}

void Project::SetBeats(std::vector<double> times, std::vector<int> counted, int in_bar,
                       const std::string& name) {
  const auto check = [](int count, const std::string& field) {
    if (count >= 1 && count <= kMaxBeatsInBar) return;
    throw InvalidArgument(field, std::to_string(count) + " is not a whole number from 1 to " +
                                     std::to_string(kMaxBeatsInBar));
  };
  check(in_bar, name + ":bar");
  CheckGivenBeats(times, name + ":beats");
  if (counted.size() != times.size())
    throw InvalidArgument(name + ":beats", "and their counts are not equally many");
  std::vector<double> bars, eights;
  for (size_t i = 0; i < times.size(); ++i) {
    check(counted[i], name + ":beats[" + std::to_string(i) + "]");
    if ((counted[i] - 1) % in_bar == 0) bars.push_back(times[i]);
    if (counted[i] == 1) eights.push_back(times[i]);
  }
  beats = std::move(times);
  downbeats = std::move(bars);
  ones = std::move(eights);
  counts = std::move(counted);
  bar = in_bar;
}

void CheckProject(const Project& project, const std::string& name) {
  project.CheckNumbers(name + ":");
  if (project.seconds && !(*project.seconds > 0 && *project.seconds <= kMaxDanceSeconds)) {
    throw InvalidArgument(
        name + ":seconds",
        InFull(*project.seconds) + " is not above 0 and up to " + InFull(kMaxDanceSeconds));
  }
  CheckMarkers(project.markers, name + ":markers");
}

void RequireSong(const Project& project, const std::string& song, const std::string& name) {
  if (song.empty() && !project.beats.empty()) throw InvalidArgument(name + ":beats", "need a song");
}

Project ReadProject(const std::filesystem::path& path) {
  Project project =
      ParseProject(ParseJson(ReadText(path, "project"), path.string()), path.string());
  if (!project.song.empty()) project.song = (path.parent_path() / project.song).string();
  return project;
}

}  // namespace choreo::authoring
