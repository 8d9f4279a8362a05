#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/authoring/dance_keys.h"
#include "client/authoring/music.h"
#include "client/authoring/written_controls.h"
#include "client/cli/bvh_options.h"
#include "client/cli/connection.h"
#include "client/cli/vmc_show.h"
#include "client/cli/written_dance.h"

namespace choreo::cli {

/// The options of `choreo dance`.
struct DanceOptions : DanceManner {
  ServerOptions server;
  std::string song;
  authoring::BeatOptions beats;
  std::vector<std::string> keys;
  std::string end;  ///< the pose to end in, as ReadPose takes it; or empty
  /// A dancer who begins later ends as much earlier in her own time, which is cut off there.
  std::optional<authoring::WrittenTime> after;
  std::string after_name;  ///< the field of errors about it
  std::string project;
  /// Seconds of the dance; `project_ones` begin an eight.
  std::vector<double> project_beats, project_downbeats, project_ones;
  std::optional<double> seconds;
  double song_start_s = 0;
  std::optional<uint64_t> seed;
  std::optional<uint64_t> way_seed;    ///< whose way over the floor library poses keep to
  std::string style_name = "--style";  ///< the field of errors about it
  double fps = 0;
  authoring::WrittenControls controls;
  std::string model;
  std::string dancers;  ///< a file (dancers.h); empty: a single dancer
  std::string out;
  std::string report;
  std::string vmc;
  BvhOptions bvh;
  bool no_clobber = false;
  bool allow_bends = false;
};

/// A dance that can begin: its options are checked, and its keys fit into it.
struct PlannedDance {
  DanceOptions options;
  authoring::DanceLength length;
  authoring::DanceKeys keys = {};
  std::vector<client::Warning> faults = {};  ///< of the keys
  client::DanceConfig config = {};
  client::Audio audio = {};
};

/// A dance and facts about it.
struct Performance {
  client::DanceResult dance;
  WrittenDance written;
};

/// Reads the keys for SMPL's skeleton: throws what Plan would throw of their files, before a
/// server is started.
void CheckKeyFiles(const DanceOptions& options, const std::optional<authoring::Music>& music);

/// Plans a dance as the options say, to this music, their song's, and prints warnings of its keys.
/// Errors name the option, or the place in a file.
PlannedDance Plan(const DanceOptions& options, const std::optional<authoring::Music>& music,
                  const Connection& connection);

/// Dances as planned. Writes what came of a failed or interrupted dance beside `out`. The show of
/// --vmc starts with the dance. Errors are those of Plan.
Performance Perform(const PlannedDance& plan, const Connection& connection,
                    const std::filesystem::path& out, std::optional<VmcShow>* show);

}  // namespace choreo::cli
