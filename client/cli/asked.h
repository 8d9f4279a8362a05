#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "client/dance_config.h"
#include "model/motion/control_request.h"

namespace choreo::cli {

/// The value of --song that means no music, not even the report's.
inline constexpr const char* kNoSong = "none";

/// A dance's request beside its keys. Its report states it for later edits.
struct Asked : DanceManner {
  std::string model = {};
  std::optional<uint64_t> seed = {};
  std::string song = {};  ///< the file as it was named
  double song_start_s = 0;
  /// Seconds of the dance, unless they are those found in the song.
  std::vector<double> beats = {}, downbeats = {};
  ControlRequest controls = {};

  /// Adds it to a report.
  void WriteTo(nlohmann::ordered_json* report) const;
  /// Reads the report called `name`; reports of earlier versions say less. Throws
  /// Error(kInvalidArgument) whose field is NAME:MEMBER.
  static Asked ReadFrom(const nlohmann::ordered_json& report, const std::string& name);

  /// Fills in the song of a command from this, of the report called `report`, unless the command
  /// line names one; and its start for this song, unless it says that. Looks for the file here and
  /// beside the report. `without`: the effect of a missing song, for a note. Returns whether it
  /// filled in a song.
  bool TakeSong(const std::filesystem::path& report, bool says_start, const std::string& without,
                std::string* to, double* start_s) const;

  /// What was asked for the dance from this second on, of a model at `fps`.
  Asked From(double seconds, double fps) const;
};

}  // namespace choreo::cli
