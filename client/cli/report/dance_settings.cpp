#include "client/cli/report/dance_settings.h"

#include <cmath>
#include <iostream>
#include <string_view>

#include "client/authoring/json_fields.h"
#include "client/cli/report/report_controls.h"
#include "model/audio/signal/format.h"
#include "model/core/error.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"

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
  const auto check = [&](const char* member, std::optional<double> value, double most) {
    if (!value || (*value >= 0 && *value <= most)) return;
    throw InvalidArgument(place + member, InFull(*value) + " is not within 0 to " + InFull(most));
  };
  const auto check_setting = [&](const char* member, const auto& value) {
    if constexpr (requires { value.has_value(); })
      check(member, value, std::string_view(member) == "temperature" ? kMaxTemperature : 1);
  };
  DanceManner::VisitSettings(check_setting, *this);
  check("song_start", song_start_s, authoring::kMaxSeconds);
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
