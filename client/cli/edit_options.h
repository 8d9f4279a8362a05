#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "client/authoring/music_beats.h"
#include "client/authoring/written_controls.h"
#include "client/cli/connection.h"
#include "client/cli/report_keys.h"
#include "client/edit.h"

namespace choreo::cli {

/// The options of `choreo edit`.
struct EditOptions {
  ServerOptions server;
  std::string dance;
  std::vector<std::string> keys;
  std::vector<double> at_s;
  std::vector<std::pair<std::string, double>> moves;  ///< keys of the report, and seconds
  std::vector<std::string> removed;                   ///< keys of the report
  /// Phrases: start, end, and the delay of their repeat (counts.h).
  std::vector<std::tuple<double, double, std::string>> repeats;
  std::vector<std::tuple<double, double, double>> stretches;  ///< phrases: start, end, factor
  std::optional<double> hold_s;                               ///< of `keys`
  std::optional<double> hit;                                  ///< of `keys` and `moves`
  std::string hands;                                          ///< the same; or empty
  bool in_place = false;
  bool allow_bends = false;
  bool loop = false;
  std::optional<double> around_s;
  std::string song;
  double song_start_s = 0;
  authoring::BeatOptions beats;
  std::string report;
  std::string new_report;
  std::optional<uint64_t> seed;
  std::optional<double> temperature;
  std::optional<double> music_dynamics;
  std::optional<double> variation;
  std::string style;
  authoring::WrittenControls controls;
  std::string model;
  std::string out;

  // For projects (edit_markers.h).
  std::vector<std::pair<std::string, double>> marks;  ///< names and seconds
  std::vector<std::string> unmarked;

  // For whole dances (edit_whole.h).
  std::optional<double> from_s, until_s;
  bool mirror = false;
  std::string join, join_report;
  std::optional<double> gap_s;
};

/// The settings for new frames, without a song.
client::EditOptions HowToDance(const EditOptions& options, const Connection& connection);
/// Adds the song up to `end_s`, if there is one, for these frames.
void TakeSong(const EditOptions& options, double end_s, client::EditOptions* edit);
/// The parts of a dance's report that edits keep: its keys, by frame, and warnings.
struct KnownDance {
  ReportKeys keys = {};
  std::vector<client::Warning> warnings = {};
};
/// Reads them from a report, for a dance of this many frames of a model at this rate. Throws
/// Error(kInvalidArgument) whose field begins with the report's name.
KnownDance ReadKnown(const std::string& report, int64_t frames, double fps);
/// Writes them as a report, for the next edit.
void WriteKnown(const std::filesystem::path& path, const KnownDance& known, int64_t frames,
                double fps);

}  // namespace choreo::cli
