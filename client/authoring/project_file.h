#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/authoring/written_controls.h"
#include "client/dance_config.h"

namespace choreo::authoring {

/// A named moment of a dance.
struct Marker {
  double time_s = 0;
  std::string name;
};

/// A studio project without its keys, which ReadKeys reads like those of a key file (key_file.h).
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
  bool has_keys = false;     ///< whether there are keys for ReadDanceKeys
  bool has_dancers = false;  ///< whether there are several dancers, for ReadDancers (dancers.h)
};

/// Parses a project: JSON with `studio` (1), `song`, `seconds`, `seed`, a manner's settings except
/// `temperature`, `beats` (each with its second and count), `bar` (its number of beats), `controls`
/// (by their names, with the fields of the API's messages), `path` (as in a path file), `lively`
/// (the velocity factors of parts, in older projects), `markers` (each with `time` and `name`; no
/// frame depends on them), `dancers` and `apart` (both ignored here), and `keyframes`. `name` is
/// the file's. Throws Error(kInvalidArgument) whose field is NAME:MEMBER, naming value and limit.
Project ParseProject(const nlohmann::json& file, const std::string& name,
                     std::span<const ControlRow> rows = kControls);

/// Reads a project from a file, to which the song's path is relative. Throws as ParseProject does,
/// and Error(kNotFound) if the project cannot be opened. Does not check that the song exists.
Project ReadProject(const std::filesystem::path& path);

/// Formats a project for people: short lists and objects, such as vectors and markers, have a line
/// each.
std::string ProjectText(const nlohmann::ordered_json& project);

}  // namespace choreo::authoring
