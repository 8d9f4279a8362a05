#include "client/authoring/project_file.h"

#include <algorithm>
#include <sstream>

#include "client/authoring/beat_options.h"
#include "client/authoring/json_fields.h"
#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/core/rounded.h"
#include "model/motion/velocity_factors.h"

namespace choreo::authoring {
namespace {

using nlohmann::json;

constexpr int kFormat = 1;

std::string Text(const json& file, const std::string& name, const char* member) {
  if (!file.contains(member)) return {};
  if (!file[member].is_string())
    throw InvalidArgument(name + ":" + member, Shown(file[member]) + " is not a text");
  return file[member].get<std::string>();
}

/// Reads a setting of the manner if the project states it.
struct SettingReader {
  const json& file;
  const std::string& name;

  void operator()(const char* member, std::string& text) const { text = Text(file, name, member); }
  void operator()(const char* member, std::optional<double>& share) const {
    if (!file.contains(member)) return;
    const std::string field = name + ":" + member;
    share = JsonNumber(file[member], field);
    if (!(*share >= 0 && *share <= 1))
      throw InvalidArgument(field, Shown(file[member]) + " is not a number from 0 to 1");
  }
};

bool IsCount(const json& value) {
  return IsFrameNumber(value) && value.get<uint64_t>() >= 1 &&
         value.get<uint64_t>() <= kMaxBeatsInBar;
}

/// Reads beats, [[0.52, 1], [1.02, 2], ...]: seconds and counts. Counts may continue over several
/// bars.
void ReadBeats(const json& list, const std::string& field, Project* project) {
  if (!list.is_array()) throw InvalidArgument(field, Shown(list) + " is not a list");
  std::vector<double>& out = project->beats;
  for (const json& beat : list) {
    const std::string at = field + "[" + std::to_string(out.size()) + "]";
    if (!beat.is_array() || beat.size() != 2 || !IsCount(beat[1])) {
      throw InvalidArgument(at, Shown(beat) + " is not a beat: its second and its count, 1 to " +
                                    std::to_string(kMaxBeatsInBar) + ", as in [12.5, 1]");
    }
    out.push_back(JsonNumber(beat[0], at));
    const int count = project->counts.emplace_back(beat[1].get<int>());
    if ((count - 1) % project->bar == 0) project->downbeats.push_back(out.back());
    if (count == 1) project->ones.push_back(out.back());
  }
  CheckBeats(out, field);
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
    const std::string marked = Text(list[i], at, "name");
    if (marked.empty()) throw InvalidArgument(at + ".name", "is empty");
    const double time = JsonNumber(list[i]["time"], at + ".time");
    const double before = markers.empty() ? -1 : markers.back().time_s;
    if (!(time > before && time <= kMaxDanceSeconds)) {
      throw InvalidArgument(at + ".time", Shown(list[i]["time"]) +
                                              " is not above the one before it and up to " +
                                              InFull(kMaxDanceSeconds));
    }
    markers.push_back({time, marked});
  }
  return markers;
}

std::string Readable(const nlohmann::ordered_json& value, const std::string& indent) {
  using nlohmann::ordered_json;
  const bool is_flat =
      std::ranges::none_of(value, [](const ordered_json& part) { return part.is_structured(); });
  const bool is_line = !indent.empty() && is_flat && (value.is_array() || value.size() < 4);
  if (!value.is_structured()) return value.dump();
  const std::string next = is_line ? "" : "\n" + indent + " ";
  std::string parts;
  for (const auto& [member, part] : value.items()) {
    if (!parts.empty()) parts += is_line ? ", " : ",";
    parts += next;
    if (value.is_object()) parts += ordered_json(member).dump() + ": ";
    parts += Readable(part, indent + " ");
  }
  if (!is_line) parts += "\n" + indent;
  return value.is_object() ? "{" + parts + "}" : "[" + parts + "]";
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
  if (file["studio"] != kFormat) {
    throw InvalidArgument(name + ":studio", "is format " + Shown(file["studio"]) + ", known is " +
                                                std::to_string(kFormat));
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
  if (file.contains("seconds")) {
    project.seconds = JsonNumber(file["seconds"], name + ":seconds");
    if (!(*project.seconds > 0 && *project.seconds <= kMaxDanceSeconds)) {
      std::ostringstream message;
      message << Shown(file["seconds"]) << " is not above 0 and up to " << kMaxDanceSeconds;
      throw InvalidArgument(name + ":seconds", message.str());
    }
  }
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
  project.bar = file.value("bar", kDefaultBar);
  if (file.contains("beats")) ReadBeats(file["beats"], name + ":beats", &project);
  ReadControls(file, name, rows, &project.controls);
  if (file.contains("markers")) project.markers = MarkersIn(file["markers"], name + ":markers");
  project.has_dancers = file.contains("dancers");
  return project;
}

Project ReadProject(const std::filesystem::path& path) {
  Project project =
      ParseProject(ParseJson(ReadText(path, "project"), path.string()), path.string());
  if (!project.song.empty()) project.song = (path.parent_path() / project.song).string();
  return project;
}

std::string ProjectText(const nlohmann::ordered_json& project) {
  return Readable(project, "") + "\n";
}

}  // namespace choreo::authoring
