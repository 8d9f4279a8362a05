#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/dance_config.h"
#include "model/motion/controls/control_request.h"

namespace choreo::cli {

/// The value of --song that means no music, not even the report's.
inline constexpr const char* kNoSong = "none";

/// The user's request for a dance, except its keys. The dance's report has it for later edits.
struct DanceSettings : DanceManner {
  std::string model = {};
  std::optional<uint64_t> seed = {};
  std::optional<uint64_t> take_seed = {};  ///< of the last retake of a part
  std::string song = {};                   ///< the file's name as given
  double song_start_s = 0;
  /// In seconds of the dance; empty: found in the song.
  std::vector<double> beats = {}, downbeats = {};
  ControlRequest controls = {};

  /// Sets an empty `to` to these settings' song, and clears kNoSong. If `to` then is that song, or
  /// a file of its name, sets `start_s` to its start, unless the command line has one
  /// (`says_start`). Looks for the file in the working directory and beside `report`, the report
  /// with these settings. `without`: for a note, the effect of a missing song. Returns whether it
  /// set the song.
  bool FillSong(const std::filesystem::path& report, bool says_start, const std::string& without,
                std::string* to, double* start_s) const;

  /// Throws Error(kInvalidArgument), whose field is a report's member after `place`, for settings
  /// that no dance has.
  void Check(const std::string& place) const;

  /// The settings of the dance's part from this second on. `fps`: the model's.
  DanceSettings From(double seconds, double fps) const;
};

}  // namespace choreo::cli
