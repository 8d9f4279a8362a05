#pragma once

#include <filesystem>
#include <vector>

namespace choreo {

/// What `choreo-lab eval --music` measures.
struct HearArguments {
  std::filesystem::path model;               ///< checkpoint
  std::vector<std::filesystem::path> music;  ///< songs, and folders of them
  std::filesystem::path json;                ///< or nothing
};

/// Prints EvaluateHearing's table, and writes it where that is wanted. Throws
/// Error(kInvalidArgument, "--music") for a folder without songs; otherwise as MakeSampler and
/// DecodeAudioFile do.
void HearSongs(const HearArguments& arguments);

}  // namespace choreo
