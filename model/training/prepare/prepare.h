#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace choreo {

/// Options for converting raw recordings to prepared clips (prepared_clip.h). Preparation applies
/// each layout's corrections, resamples to 30 fps, fits rotations to SMPL's skeleton or the data's
/// own, and adds contacts and music rows.
struct PrepareOptions {
  std::string layout;            ///< "tang2018" | "tang61" | "bvh" | "amass" | "aist" | "lafan1"
  std::filesystem::path input;   ///< folder
  std::filesystem::path output;  ///< folder, created
  /// Clips whose name starts with .first have .second fps, whatever their file states (cmu_dance's
  /// salsa: 60).
  std::vector<std::pair<std::string, double>> frame_rates;
  /// Clips whose name starts with .first are stretched in time by .second; tang2018 has its own
  /// factors (1.0125 for waltz and rumba).
  std::vector<std::pair<std::string, double>> time_scales;
  /// tang2018 only: fits rotations to a skeleton made from the recordings
  /// (fit/sources/tang2018_skeleton.h), not to SMPL's.
  bool native_skeleton = false;
  std::string terms = "not stated";  ///< terms of use, stored with every clip
  int jobs = 2;
};

/// Prepares every clip, showing progress. Prints one line per clip and the means. Writes
/// OUT/report.json and, for "aist" and "lafan1", OUT/splits.json. Names and skips unreadable clips.
/// Returns the number of prepared clips. Throws Error if the input has nothing in this layout, or
/// if the layout has no native skeleton but one is requested.
int Prepare(const PrepareOptions& options);

/// Adds the command `choreo-lab prepare`.
void AddPrepareCommand(CLI::App& app);

}  // namespace choreo
