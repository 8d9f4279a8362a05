#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/choreo_client.h"
#include "client/cli/asked.h"
#include "client/cli/motion_sketch.h"
#include "model/core/grid.h"
#include "model/motion/kinematics.h"

namespace choreo::cli {

/// A key in the written motion. If the file's rate is not the model's, a key may be between the
/// file's frames: the dance reaches it, but no frame shows it.
struct WrittenKey {
  client::KeyReached reached = {};  ///< from the server
  int64_t frame = 0;                ///< in the file: the nearest to the key's time
  bool on_frame = true;             ///< the frame is at the key's time, not only near it
  PoseError error = {};             ///< the error at that frame
  /// The id of the key whose pose this key only holds, or empty. Examine leaves it empty.
  std::string holds = {};
  std::optional<double> hit = {};      ///< KeyPose::hit
  std::optional<HandPose> hands = {};  ///< KeyPose::hands
};

/// A written dance and facts about it.
struct WrittenDance {
  client::Header header = {};
  client::Report report = {};
  bool is_complete = true;  ///< false: the server was lost, so its figures are missing
  Asked asked = {};         ///< Examine leaves it empty
  int64_t frames = 0;       ///< of the file
  double fps = kModelFps;   ///< of the file
  MotionSketch sketch = {};
  std::vector<WrittenKey> keys = {};
  std::vector<client::Warning> warnings = {};  ///< from the server; Examine leaves them empty
  /// The beat hit rate by chance (BeatHitChance). Empty without beats.
  std::optional<double> beat_hit_chance = {};
};

/// Examines the motion at every key. Throws Error(kInternal), whose field is the key's id, for a
/// key that is missing in the report.
WrittenDance Examine(const client::Header& header, const client::Report& report,
                     const Motion& motion, const std::vector<client::KeyPose>& keys);

/// The share of `frames`, at `fps`, within two frames of a beat (seconds); empty without beats.
std::optional<double> BeatHitChance(const std::vector<double>& beats, int64_t frames, double fps);

/// Checks that every key is reached within 1 mm and 0.1 degrees: in the file if a frame is at the
/// key's time, otherwise in the server's report. Throws Error(kInternal), naming the key, if not.
void CheckKeys(const WrittenDance& dance);

}  // namespace choreo::cli
