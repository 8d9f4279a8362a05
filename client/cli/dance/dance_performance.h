#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/authoring/controls/written_controls.h"
#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/music/music.h"
#include "client/cli/dance/vmc_show.h"
#include "client/cli/options/bvh_options.h"
#include "client/cli/options/connection.h"
#include "client/cli/report/written_dance.h"

namespace choreo::cli {

/// The options of `choreo dance`.
struct DanceOptions : DanceManner {
  ServerOptions server;
  std::string song;
  authoring::BeatOptions beats;
  std::vector<std::string> keys;
  std::string end;  ///< the pose to end in, a source for ReadPose; or empty
  /// The dancer's delay. The delayed dance ends with the others, so its own end is cut off.
  std::optional<authoring::WrittenTime> after;
  std::string after_name;  ///< the field of errors about `after`
  std::string project;
  /// Beats of the project, in seconds of the dance; `project_ones` begin an eight.
  std::vector<double> project_beats, project_downbeats, project_ones;
  std::optional<double> seconds;
  double song_start_s = 0;
  std::optional<uint64_t> seed;
  std::optional<uint64_t> way_seed;    ///< seed of the path over the floor of library poses
  std::string style_name = "--style";  ///< the field of errors about the style
  double fps = 0;
  authoring::WrittenControls controls;
  std::string model;
  std::string dancers;             ///< a file (dancers.h); empty: a single dancer
  std::string dancers_named = {};  ///< those of `dancers` who share this dance: "ada, ben"
  std::string out;
  std::string report;
  std::string vmc;
  BvhOptions bvh;
  bool no_clobber = false;
  bool allow_bends = false;
};

/// A dance that is ready to begin: its options are checked, and its keys fit into it.
struct PlannedDance {
  DanceOptions options;
  authoring::DanceLength length;
  authoring::Counts counts = {};  ///< of the song
  authoring::DanceKeys keys = {};
  std::vector<client::Warning> faults = {};  ///< warnings about the keys
  client::DanceConfig config = {};
  client::Audio audio = {};
};

/// A dance and facts about it.
struct Performance {
  client::DanceResult dance;
  WrittenDance written;
};

/// Checks the key files, for SMPL's skeleton, before a server starts. Throws what Plan would throw.
void CheckKeyFiles(const DanceOptions& options, const std::optional<authoring::Music>& music);

/// Plans the dance that the options describe, and prints warnings about its keys. `music`: the
/// options' song. Errors name the option, or the place in a file.
PlannedDance Plan(const DanceOptions& options, const std::optional<authoring::Music>& music,
                  const Connection& connection);

/// Performs a planned dance. If it fails or is interrupted, writes the received frames beside
/// `out`. Starts the `show` of --vmc with the dance. Errors name the option, or the place in a
/// file.
Performance Perform(const PlannedDance& plan, const Connection& connection,
                    const std::filesystem::path& out, std::optional<VmcShow>* show);

}  // namespace choreo::cli
