#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "client/cli/control_options.h"

namespace choreo::cli {

/// What a project of the studio says beside its keys, which are read as a key file's (key_file.h).
struct Project {
  std::string song = {};  ///< the file's name; empty: it has none
  std::optional<double> seconds = {};
  std::optional<uint64_t> seed = {};
  std::string style = {};                                     ///< empty: as it comes
  std::optional<double> music_dynamics = {}, variation = {};  ///< 0 to 1
  std::vector<double> beats = {};            ///< of the song, seconds; none: as they are found
  ControlOptions controls = {};              ///< no velocities where all are 1
  bool has_dancers = false;                  ///< several, whom ReadDancers reads (dancers.h)
};

/// Reads a project, JSON with `studio`, which is 1, `song`, `seconds`, `seed`, `style`,
/// `music_dynamics`, `variation`, `beats` (of each its second and its count), `bar` (beats in one),
/// `lively` (a factor for each part of the body), `path`, `dancers` and `apart` (which are not
/// looked at), and `keyframes`. `name` is the file's. Throws Error(kInvalidArgument) whose field is
/// NAME:MEMBER, naming value and limit.
Project ParseProject(const nlohmann::json& file, const std::string& name);

/// The same of a file, whose song is the one beside it. Throws Error(kNotFound) where it cannot be
/// opened. Whether the song is there is not looked at.
Project ReadProject(const std::filesystem::path& path);

}  // namespace choreo::cli
