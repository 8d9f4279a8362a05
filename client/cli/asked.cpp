#include "client/cli/asked.h"

#include <cmath>
#include <iostream>

#include "client/authoring/json_fields.h"
#include "client/cli/asked_controls.h"
#include "model/core/error.h"

namespace choreo::cli {
namespace {

using nlohmann::ordered_json;

template <typename Report, typename AskedFor, typename Visit>
void VisitMembers(Report& report, AskedFor& asked, const Visit& visit) {
  visit(report, "model", asked.model);
  visit(report, "seed", asked.seed);
  visit(report, "temperature", asked.temperature);
  visit(report, "music_dynamics", asked.music_dynamics);
  visit(report, "variation", asked.variation);
  visit(report, "style", asked.style);
  visit(report, "song", asked.song);
  visit(report, "song_start", asked.song_start_s);
  visit(report, "music_beats", asked.beats);
  visit(report, "music_downbeats", asked.downbeats);
}

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

struct MemberWriter {
  template <typename Value>
  void operator()(ordered_json& report, const char* member, const Value& value) const {
    if (value != Value()) report[member] = value;
  }
  template <typename Value>
  void operator()(ordered_json& report, const char* member,
                  const std::optional<Value>& value) const {
    if (value) report[member] = *value;
  }
};

struct MemberReader {
  const std::string& name;

  template <typename Value>
  void operator()(const ordered_json& report, const char* member, Value& value) const {
    if (!report.contains(member)) return;
    try {
      report[member].get_to(value);
    } catch (const nlohmann::json::exception&) {
      throw InvalidArgument(name + ":" + member,
                            authoring::Shown(report[member]) + " is not what a report says there");
    }
  }
  template <typename Value>
  void operator()(const ordered_json& report, const char* member,
                  std::optional<Value>& value) const {
    if (report.contains(member)) (*this)(report, member, value.emplace());
  }
};

}  // namespace

void Asked::WriteTo(ordered_json* report) const {
  VisitMembers(*report, *this, MemberWriter());
  WriteControls(controls, report);
}

Asked Asked::ReadFrom(const ordered_json& report, const std::string& name) {
  Asked asked;
  VisitMembers(report, asked, MemberReader{name});
  asked.controls = ReadControls(report, name);
  return asked;
}

bool Asked::TakeSong(const std::filesystem::path& report, bool says_start,
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
                << ", is not there; without --song " << without << '\n';
      return false;
    }
  } else if (std::filesystem::path(*to).filename() != std::filesystem::path(song).filename()) {
    return false;
  }
  if (!says_start) *start_s = song_start_s;
  return takes;
}

Asked Asked::From(double seconds, double fps) const {
  Asked later = *this;
  later.controls = Delayed(controls, -std::llround(seconds * fps));
  if (!song.empty()) later.song_start_s += seconds;
  for (std::vector<double>* times : {&later.beats, &later.downbeats}) {
    for (double& time : *times) time -= seconds;
    std::erase_if(*times, [](double time) { return time < 0; });
  }
  return later;
}

}  // namespace choreo::cli
