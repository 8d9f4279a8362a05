#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/fit/position_clip.h"
#include "model/fit/sources.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/training/beat_grid.h"

namespace choreo {

/// Raw recordings → prepared clips (prepared_clip.h): the corrections that each layout needs, 30
/// fps, rotations fitted to SMPL's skeleton or the data's own, contacts, and the rows of the music.
struct PrepareOptions {
  std::string layout;            ///< "tang2018" | "tang61" | "bvh" | "amass" | "aist" | "lafan1"
  std::filesystem::path input;   ///< folder
  std::filesystem::path output;  ///< folder, created
  /// Clips whose name starts with .first run at .second fps, whatever their file says (cmu_dance's
  /// salsa: 60).
  std::vector<std::pair<std::string, double>> frame_rates;
  /// Time of clips whose name starts with .first is stretched by .second; tang2018 has its own
  /// (1.0125 for waltz and rumba).
  std::vector<std::pair<std::string, double>> time_scales;
  /// tang2018 alone: rotations are fitted to a skeleton made from the recordings themselves
  /// (fit/tang2018_skeleton.h) instead of SMPL's.
  bool native_skeleton = false;
  std::string terms = "not stated";  ///< kept with every clip
  int jobs = 2;
};

/// One recording, read but not corrected. Positions for the layouts without rotations, `motion` for
/// those with SMPL rotations.
struct Recording {
  std::string name;
  std::string genre;  ///< kept with the clip; empty: not stated
  PositionClip positions;
  std::optional<Motion> motion;
  SourceMapping mapping;
  Skeleton skeleton = Skeleton::Smpl24();  ///< that rotations are fitted to, or are of
  bool ground = false;                     ///< bring the body of `motion` down to the floor
  bool tilted_floor = false;               ///< fit and level a floor plane, take out height drift
  double cutoff_hz = 0;                    ///< low-pass before resampling; 0: none
  double time_scale = 1;
  std::filesystem::path music;    ///< empty: none
  double music_start_s = 0;       ///< of the motion's first frame within the music
  bool expects_music = false;     ///< warn where there is none
  std::optional<BeatGrid> beats;  ///< that the motion stands on, of its own time
};

/// The value of the first prefix that a clip's name starts with.
double ForClip(const std::vector<std::pair<std::string, double>>& values, const std::string& name,
               double otherwise);

/// What a layout offers: clip names and how to read each.
struct RecordingSource {
  std::string name;
  std::function<Recording()> read;
};
std::vector<RecordingSource> ListRecordings(const PrepareOptions& options);

/// Prepares every clip, showing progress; prints one line a clip and the means, writes
/// OUT/report.json, for "aist" and "lafan1" OUT/splits.json, too. A clip that can't be read is
/// named with its reason and skipped. Returns the number of prepared clips. Throws Error where the
/// input has nothing of the layout, or a native skeleton is asked of a layout that has none.
int Prepare(const PrepareOptions& options);

}  // namespace choreo
