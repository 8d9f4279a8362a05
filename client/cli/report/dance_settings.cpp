#include "client/cli/report/dance_settings.h"

#include <cmath>
#include <iostream>

#include "client/authoring/fields/json_fields.h"
#include "client/cli/report/report_controls.h"
#include "model/audio/signal/format.h"
#include "model/core/range.h"

namespace choreo::cli {
namespace {

/// Finds the song that a report names, in the working directory or beside the report; empty if
/// there is none.
std::string FindSong(const std::string& song, const std::filesystem::path& report) {
  for (const std::filesystem::path& path :
       {std::filesystem::path(song), report.parent_path() / song}) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) return path.string();
  }
  return "";
}

}  // namespace

bool DanceSettings::FillSong(const std::filesystem::path& report, bool says_start,
                             const std::string& without, std::string* to, double* start_s) const {
  if (*to == kNoSong) {
    to->clear();
    return false;
  }
  if (song.empty()) return false;
  const bool takes = to->empty();
  if (takes) {
    *to = FindSong(song, report);
    if (to->empty()) {
      std::cerr << "note: " << song << ", the song of " << report.string()
                << ", does not exist; without --song " << without << '\n';
      return false;
    }
  } else if (std::filesystem::path(*to).filename() != std::filesystem::path(song).filename()) {
    return false;
  }
  if (!says_start) *start_s = song_start_s;
  return takes;
}

void DanceSettings::Check(const std::string& place) const {
  CheckNumbers(place);
  Range{0, authoring::kMaxSeconds}.Check(song_start_s, place + "song_start");
  CheckBeats(beats, place + "music_beats");
  CheckDownbeats(downbeats, beats, place + "music_downbeats");
}

DanceSettings DanceSettings::From(double seconds, double fps) const {
  DanceSettings later = *this;
  later.controls = Delayed(controls, -std::llround(seconds * fps));
  if (!song.empty()) later.song_start_s += seconds;
  for (std::vector<double>* times : {&later.beats, &later.downbeats}) {
    for (double& time : *times) time -= seconds;
    std::erase_if(*times, [](double time) { return time < 0; });
  }
  return later;
}

}  // namespace choreo::cli
