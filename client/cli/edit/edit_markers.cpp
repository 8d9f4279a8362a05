#include "client/cli/edit/edit_markers.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "client/authoring/fields/counts.h"
#include "client/authoring/fields/json_fields.h"
#include "client/authoring/music/music.h"
#include "client/authoring/project/project_file.h"
#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/small_extension.h"
#include "model/core/grid.h"
#include "model/core/rounded.h"
#include "model/core/text/nearest.h"

namespace choreo::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kMarkers = "markers";

double TimeOf(const ordered_json& marker) { return marker["time"].get<double>(); }

std::string Spoken(const ordered_json& marker) {
  return marker["name"].get<std::string>() + '@' + Rounded(TimeOf(marker));
}

/// Finds the marker called NAME, or NAME@SECOND if several have that name; the end if there is
/// none.
ordered_json::iterator Find(ordered_json& markers, const std::string& id, const char* option) {
  std::vector<ordered_json::iterator> found;
  for (auto marker = markers.begin(); marker != markers.end(); ++marker) {
    if (Spoken(*marker) == id) return marker;
    if ((*marker)["name"] == id) found.push_back(marker);
  }
  if (found.size() > 1) {
    throw InvalidArgument(option, "several markers are called \"" + id + "\"; say which, as in " +
                                      Spoken(*found.front()));
  }
  return found.empty() ? markers.end() : found.front();
}

void Remove(const std::string& id, ordered_json* markers) {
  const auto found = Find(*markers, id, "--unmark");
  if (found != markers->end()) return void(markers->erase(found));
  throw InvalidArgument(
      "--unmark", "the project has no marker \"" + id + "\"; " + DidYouMean(id, *markers, &Spoken));
}

/// The counts that the studio's ruler shows: the project's beats, or those of its song.
authoring::Counts CountsOf(const authoring::Project& project, const EditOptions& options) {
  if (!project.beats.empty()) return authoring::CountsFrom(project.beats, project.ones);
  const std::string& song = options.song.empty() ? project.song : options.song;
  if (song.empty()) return {};
  return authoring::CountsOf(authoring::ReadMusic(song, std::numeric_limits<double>::infinity(),
                                                  options.song_start_s, options.beats));
}

/// Sets a marker, or moves the existing one of this name.
void Mark(const std::string& id, double time_s, ordered_json* markers) {
  ordered_json marker = {{"time", time_s}, {"name", id}};
  const auto old = Find(*markers, id, "--mark");
  if (old != markers->end()) {
    marker["name"] = (*old)["name"];
    markers->erase(old);
  }
  const auto frame = [](double seconds) { return std::llround(seconds * kModelFps); };
  const auto there = std::ranges::find_if(
      *markers, [&](const ordered_json& other) { return frame(TimeOf(other)) == frame(time_s); });
  if (there != markers->end())
    throw InvalidArgument("--mark", InFull(time_s) + " s is where " + Spoken(*there) + " stands");
  const auto next = std::ranges::find_if(
      *markers, [&](const ordered_json& other) { return TimeOf(other) > time_s; });
  markers->insert(next, std::move(marker));
}

}  // namespace

bool IsProject(const EditOptions& options) { return SmallExtension(options.dance) == ".json"; }

void EditMarkers(const EditOptions& options) {
  const std::string text = authoring::ReadText(options.dance, "project");
  const authoring::Project read = authoring::ReadProject(options.dance);
  auto project = ordered_json::parse(text);
  ordered_json markers = project.value(kMarkers, ordered_json::array());
  for (const std::string& id : options.unmarked) Remove(id, &markers);
  for (const auto& [id, time] : options.marks) {
    const authoring::WrittenTime at = authoring::ParseTime(time, "--mark");
    const double second =
        at.In(at.counts ? CountsOf(read, options) : authoring::Counts(), "--mark");
    authoring::CheckInADance(second, "--mark");
    Mark(id, second, &markers);
  }
  if (markers.empty()) {
    project.erase(kMarkers);
  } else {
    project[kMarkers] = std::move(markers);
  }
  WriteFile(options.out, authoring::ProjectText(project));
  std::cout << options.out << std::endl;
}

}  // namespace choreo::cli
