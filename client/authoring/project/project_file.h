#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/authoring/controls/written_controls.h"
#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/project/dancers.h"
#include "client/dance_config.h"

namespace choreo::authoring {

inline constexpr int kProjectFormat = 1;  ///< the value of `studio`

/// A named moment of a dance.
struct Marker {
  double time_s = 0;
  std::string name;
};

/// A studio project: all inputs of a dance, from a file or the studio's page.
struct Project : DanceManner {
  std::string song = {};  ///< the file's name; empty: no song
  std::optional<double> seconds = {};
  std::optional<uint64_t> seed = {};
  /// The song's beats and downbeats, seconds; empty: to be found. Each downbeat is also a beat.
  std::vector<double> beats = {}, downbeats = {};
  std::vector<double> ones = {};  ///< downbeats that begin an eight
  int bar = 0;                    ///< number of beats in a bar
  std::vector<int> counts = {};   ///< the count of each beat
  std::vector<Marker> markers = {};
  WrittenControls controls = {};
  bool has_keys = false;     ///< whether a file has keys
  bool has_dancers = false;  ///< whether a file has several dancers
  /// ParseProject leaves these empty, because keys need a skeleton, and perhaps the song's counts.
  /// KeysIn (key_file.h) reads the keys, ParseDancers the dancers.
  DanceKeys keys = {};
  Dancers stage = {};

  /// Sets the song's beats and their counts, which may run over several bars, and finds the beats
  /// that begin a bar or an eight. Throws Error(kInvalidArgument) whose field begins with
  /// NAME:beats or NAME:bar, and then changes nothing.
  void SetBeats(std::vector<double> times, std::vector<int> counted, int in_bar,
                const std::string& name);
};

/// Parses a project: JSON with `studio` (1), `song`, `seconds`, `seed`, a manner's settings except
/// `temperature`, `beats` (each with its second and count), `bar` (its number of beats), `controls`
/// (by their names, with the fields of the API's messages), `path` (as in a path file), `lively`
/// (the velocity factors of parts, in older projects), `markers` (each with `time` and `name`; no
/// frame depends on them), `dancers` and `apart` (both ignored here), and `keyframes`. `name` is
/// the file's. Throws as CheckProject does.
Project ParseProject(const nlohmann::json& file, const std::string& name,
                     std::span<const ControlRow> rows = kControls);

/// Reads a project from a file; the song's path is relative to it. Throws as ParseProject does, and
/// Error(kNotFound) if the project cannot be opened. Does not check that the song exists.
Project ReadProject(const std::filesystem::path& path);

/// Checks all but beats, controls, keys and dancers. Throws Error(kInvalidArgument) whose field is
/// NAME:MEMBER, naming value and limit.
void CheckProject(const Project& project, const std::string& name);

/// Throws Error(kInvalidArgument, NAME:beats) for a project's beats without a song to dance to.
void RequireSong(const Project& project, const std::string& song, const std::string& name);

/// The second that a project has for a frame: short, and read back as the same frame.
double SecondsOf(int64_t frame, double fps);

/// Writes a project, with its keys and dancers, so that each float and each frame stays the same
/// when it is read. `fps`: the model's.
nlohmann::ordered_json ProjectJson(const Project& project, const Skeleton& skeleton, double fps);

/// Formats a project for people: short lists and objects, such as vectors and markers, have a line
/// each.
std::string ProjectText(const nlohmann::ordered_json& project);

}  // namespace choreo::authoring
