#pragma once

#include <optional>
#include <span>
#include <string>

#include "model/audio/beats.h"

namespace choreo::authoring {

inline constexpr int kMaxBeatsInBar = 16;  ///< that people count to
inline constexpr int kDefaultBar = 4;      ///< beats, where nobody says how many

/// Options that override the beat tracker.
struct BeatOptions {
  std::string beats = "auto";  ///< or the name of a file
  std::optional<double> tempo_bpm = {};
  bool half_time = false, double_time = false;
  std::optional<double> downbeat_s = {};  ///< of the song

  bool operator==(const BeatOptions&) const = default;
};

/// Throws Error(kInvalidArgument) for beat options without a song.
void RequireSong(const BeatOptions& options, const std::string& song);

/// A song's beats from second `start` on, found or read, depending on the options. Throws
/// Error(kInvalidArgument), whose field is "beats", "downbeat" or a line of the file.
BeatTrack BeatsAsAsked(std::span<const Onset> onsets, double start, const BeatOptions& options);

}  // namespace choreo::authoring
