#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "client/authoring/fields/counts.h"
#include "client/cli/report/dance_faults.h"
#include "client/cli/report/dance_settings.h"
#include "client/cli/report/motion_sketch.h"
#include "client/dance_messages.h"
#include "model/core/grid.h"
#include "model/fit/bones/finger_bones.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo::cli {

/// A key in a dance's report, as it was danced. Figures that the report lacks are NaN.
struct ReportKey : client::KeyReached {
  /// The key in the written file. At another rate than the model's, a key may lie between the
  /// file's frames: the dance reaches it, but no frame shows it.
  struct InFile {
    int64_t frame = 0;     ///< the nearest to the key's time
    bool on_frame = true;  ///< the frame is at the key's time, not only near it
    PoseError error = {};  ///< at that frame
  };

  std::string holds = {};              ///< id of the key whose pose this key only holds; or empty
  std::optional<double> hit = {};      ///< KeyPose::hit
  std::optional<InFile> in_file = {};  ///< none after an edit that changed the key or its frame
};

/// Keys by frame, at the model's rate.
using ReportKeys = std::map<int64_t, ReportKey>;

/// The parts of a dance's report that later commands read.
struct ReportFile {
  std::optional<int64_t> frames = {};  ///< at the model's rate; old reports lack it
  double fps = kModelFps;              ///< of the model
  MotionSketch sketch = {};            ///< with which edits recognise the dance; may be empty
  DanceSettings settings = {};
  ReportKeys keys = {};
  std::vector<client::Warning> warnings = {};
  /// Of the written motion. Not read: an edit finds those of the new dance.
  std::vector<DanceFault> faults = {};
  authoring::Counts counts = {};  ///< of the song, if known: WriteTo adds them to keys and faults

  void WriteTo(nlohmann::ordered_json* json) const;
};

/// Reads a report. Throws Error(kInvalidArgument), whose field begins with the path, for an invalid
/// one. Reports of earlier versions have fewer members.
ReportFile ReadReport(const std::filesystem::path& path);

/// Prints a note of where a dance differs from its report's sketch. Throws Error(kInvalidArgument),
/// whose field is the path, if most of the sketch differs: it is another dance's report.
void CheckSketch(const std::filesystem::path& path, const ReportFile& report, const Motion& file);

/// Moves keys `frames` later, and `in_file` frames later in the file; without `in_file` they lose
/// their places in the file.
ReportKeys Moved(ReportKeys keys, int64_t frames, std::optional<int64_t> in_file = {});

/// Finds the frames, in order, of the key called `id` and of the keys that hold its pose. ID@TIME
/// tells keys with the same id apart: it means the nearest one, at most half a count or kTooNear
/// (key_file.h) away. Throws Error(kInvalidArgument, field) unless there is exactly one, and for a
/// TIME in counts that `counts` lack.
std::vector<int64_t> FindKey(const ReportKeys& keys, const std::string& id, double fps,
                             const std::string& field, const authoring::Counts& counts);

/// The last key's frame, if that key only holds a pose.
std::optional<int64_t> HeldEnd(const ReportKeys& keys);

/// The hands' poses in a dance, in order of time.
std::vector<HandKey> HandKeys(const ReportFile& report);

}  // namespace choreo::cli
