#pragma once

#include <filesystem>
#include <vector>

namespace choreo {

/// Arguments of `choreo-lab eval --music`.
struct HearArguments {
  std::filesystem::path model;               ///< checkpoint
  std::vector<std::filesystem::path> music;  ///< songs, or folders of songs
  std::filesystem::path json;                ///< report to write; empty: none
};

/// Prints EvaluateHearing's table, and writes it to `json`, if given. Throws
/// Error(kInvalidArgument, "--music") for a folder without songs; otherwise what MakeSampler and
/// DecodeAudioFile throw.
void HearSongs(const HearArguments& arguments);

}  // namespace choreo
