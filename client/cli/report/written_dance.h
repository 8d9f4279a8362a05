#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/authoring/keys/dance_keys.h"
#include "client/choreo_client.h"
#include "client/cli/report/report_file.h"
#include "model/core/grid.h"

namespace choreo::cli {

/// A written dance and facts about it.
struct WrittenDance : ReportFile {
  client::Header header = {};
  client::Report figures = {};
  bool is_complete = true;  ///< false: the server was lost, so its figures are missing
  int64_t file_frames = 0;  ///< at `file_fps`
  double file_fps = kModelFps;
  /// The beat hit rate by chance (BeatHitChance). Empty without beats.
  std::optional<double> beat_hit_chance = {};
};

/// Examines the motion at every key. Does not fill in the request, the warnings, and which keys
/// only hold another's pose. Throws Error(kInternal), whose field is the key's id, for a key that
/// is missing in the figures.
WrittenDance Examine(const client::Header& header, const client::Report& figures,
                     const Motion& motion, const std::vector<client::KeyPose>& keys);

/// Marks the keys that only hold another one's pose.
void MarkHolds(const authoring::DanceKeys& keys, WrittenDance* dance);

/// The share of `frames`, at `fps`, within two frames of one of `beats` (seconds); empty without
/// beats.
std::optional<double> BeatHitChance(const std::vector<double>& beats, int64_t frames, double fps);

/// Checks that every key is reached within 1 mm and 0.1 degrees: in the file if a frame is at the
/// key's time, otherwise in the server's report. Throws Error(kInternal), naming the key, if not.
void CheckKeys(const WrittenDance& dance);

}  // namespace choreo::cli
