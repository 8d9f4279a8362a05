#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/choreo_client.h"
#include "model/core/grid.h"
#include "model/motion/kinematics.h"

namespace choreo::cli {

/// A key in the motion that is written. At another rate than the model's, a key may fall between
/// the frames of the file: the dance hits it, but no frame shows it.
struct WrittenKey {
  client::KeyReached reached = {};  ///< what the server says
  int64_t frame = 0;                ///< of the file: the nearest to the key's time
  bool on_frame = true;             ///< it stands at the key's time, not only near it
  PoseError error = {};             ///< of that frame
  /// The id of the key whose pose it only holds; empty for one that stands for itself. Examine
  /// leaves it empty.
  std::string holds = {};
};

/// A dance as it is written, and what is known of it.
struct WrittenDance {
  client::Header header = {};
  client::Report report = {};
  int64_t frames = 0;      ///< of the file
  double fps = kModelFps;  ///< of the file
  std::vector<WrittenKey> keys = {};
  std::vector<client::Warning> warnings = {};  ///< of the server; Examine leaves them empty
  /// The beat hit rate of a dance whose beats fall anywhere: the share of frames within two frames
  /// of a beat. Empty where there are no beats.
  std::optional<double> beat_hit_chance = {};
};

/// Looks at the motion for every key that was asked for. Throws Error(kInternal) whose field is the
/// key's id for one that the report does not have.
WrittenDance Examine(const client::Header& header, const client::Report& report,
                     const Motion& motion, const std::vector<client::KeyPose>& keys);

/// The share of `frames`, at `fps`, that lie within two frames of a beat (seconds); empty where
/// there are none.
std::optional<double> BeatHitChance(const std::vector<double>& beats, int64_t frames, double fps);

/// What is promised of a dance: every key hit to 1 mm and 0.1 degrees, in the file where a frame
/// stands at its time, else by the server's word. Throws Error(kInternal) naming the key otherwise.
void CheckKeys(const WrittenDance& dance);

}  // namespace choreo::cli
