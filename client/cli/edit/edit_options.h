#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "client/authoring/controls/written_controls.h"
#include "client/authoring/keys/placing.h"
#include "client/authoring/music/music.h"
#include "client/cli/options/connection.h"
#include "client/cli/report/dance_settings.h"
#include "client/cli/report/report_file.h"
#include "client/edit.h"

namespace choreo::cli {

/// Which settings of the whole dance the command line changes.
enum class DanceChange {
  kNothing,
  kCounts,  ///< which beats begin bars; no frame
  kSeed,
  kPath,
  kOther
};

/// The options of `choreo edit`.
struct EditOptions : DanceManner {
  ServerOptions server;
  std::string dance;
  std::vector<std::string> keys;
  // Times are seconds or counts (counts.h).
  std::vector<std::string> at;
  std::vector<std::pair<std::string, std::string>> moves;  ///< keys of the report, and times
  std::vector<std::string> removed;                        ///< keys of the report
  /// Phrases: start, end, and the delay of their repeat.
  std::vector<std::tuple<std::string, std::string, std::string>> repeats;
  std::vector<std::tuple<std::string, std::string, double>> stretches;  ///< start, end, factor
  std::vector<std::pair<std::string, std::string>> mirrored;            ///< start, end
  std::vector<std::pair<std::string, std::string>> retakes;             ///< start, end
  std::string end;             ///< the pose to end in, as in --key; or empty
  std::string hold;            ///< of `keys`; or empty
  std::optional<double> hit;   ///< of `keys` and `moves`
  std::string hands;           ///< of `keys` and `moves`; or empty
  authoring::Placing placing;  ///< of `keys`
  bool in_place = false;
  bool allow_bends = false;
  bool loop = false;
  std::optional<double> around_s;
  std::string song;  ///< "none": no song, not even the report's
  double song_start_s = 0;
  authoring::BeatOptions beats;
  std::string report;
  std::string new_report;
  std::optional<uint64_t> seed;
  authoring::WrittenControls controls;
  std::string model;
  std::string out;

  DanceChange changed = DanceChange::kNothing;  ///< before the report is read (FillFromReport)

  // Edits of projects (edit_markers.h).
  std::vector<std::pair<std::string, std::string>> marks;  ///< names and times
  std::vector<std::string> unmarked;

  // Edits of whole dances (edit_whole.h).
  std::string from, until;  ///< times; or empty
  bool mirror = false;
  std::string join, join_report;
  std::optional<double> gap_s;

  ReportFile known;        ///< the dance's report, if any (FillFromReport)
  DanceSettings settings;  ///< its request, without the beats that the options replace
};

/// Whether keys are edited: frames around them, or between two seconds, are danced anew.
bool EditsKeys(const EditOptions& options);
/// Whether the dance is cut, mirrored or joined.
bool EditsWhole(const EditOptions& options);

/// Fills in settings that the command line does not give from the report, and prints notes about
/// that. `says_start`: whether the command line gives the song's start.
void FillFromReport(bool says_start, EditOptions* options);

/// All times on the command line, with their options.
std::vector<std::pair<const char*, std::string>> TimesOf(const EditOptions& options);
/// Whether a time on the command line is in counts.
bool UsesCounts(const EditOptions& options);
/// The settings for new frames, with the song up to `end_s`, if any, and the song's counts.
std::tuple<client::EditOptions, authoring::Counts> HowToDance(const EditOptions& options,
                                                              const Connection& connection,
                                                              double end_s);
/// The counts of the song up to `end_s`; none without a song.
authoring::Counts ReadCounts(const EditOptions& options, double end_s);
/// Fits a report to its dance: `frames` at the model's `fps`, in a `file` whose rate may differ.
/// Keys in frames that the file lacks at its end move to the last frame. Prints a note if the dance
/// was edited after the report. Throws Error(kInvalidArgument), whose field begins with the
/// report's `name`, for the report of another dance.
ReportFile FitReport(ReportFile report, const std::string& name, int64_t frames, double fps,
                     const Motion& file);
/// Writes an edited dance and its report, for the next edit, to the options' files, and prints how
/// many faults the dance has. `frames`: at the model's rate.
void WriteEdited(const EditOptions& options, const Skeleton& skeleton,
                 const client::FinishedDance& dance, ReportFile report, int64_t frames);

}  // namespace choreo::cli
