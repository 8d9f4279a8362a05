#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

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

/// Prepares every clip, showing progress; prints one line a clip and the means, writes
/// OUT/report.json, for "aist" and "lafan1" OUT/splits.json, too. A clip that can't be read is
/// named with its reason and skipped. Returns the number of prepared clips. Throws Error where the
/// input has nothing of the layout, or a native skeleton is asked of a layout that has none.
int Prepare(const PrepareOptions& options);

/// `choreo-lab prepare`.
void AddPrepareCommand(CLI::App& app);

}  // namespace choreo
