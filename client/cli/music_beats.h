#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>

#include "model/audio/beats.h"

namespace choreo::cli {

inline constexpr int kMostInBar = 16;  ///< that people count to

/// What a choreographer knows better than the beat tracker.
struct BeatOptions {
  std::string beats = "auto";  ///< or a file of them
  std::optional<double> tempo_bpm = {};
  bool half_time = false, double_time = false;
  std::optional<double> downbeat_s = {};  ///< of the song

  bool operator==(const BeatOptions&) const = default;
};

/// --beats, --tempo, --half-time, --double-time, --downbeat.
void AddBeatOptions(CLI::App& command, BeatOptions* options);

/// The beats of a song from second `start` of it on, found or read, as the options say. Throws
/// Error(kInvalidArgument), whose field is an option or a line of the file.
BeatTrack BeatsAsAsked(std::span<const Onset> onsets, double start, const BeatOptions& options);

/// Beats that somebody says, in seconds. Throws Error(kInvalidArgument) of FIELD[i] as the API
/// does: for one that is not within 0 to 600, or not behind the one before, and for too many.
void CheckBeats(std::span<const double> beats, const std::string& field);

}  // namespace choreo::cli
