#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/draw/render.h"
#include "model/draw/stage.h"

namespace choreo {

inline constexpr int kMaxSheetFrames = 10'000, kMaxSheetColumns = 100;

struct ContactSheetOptions {
  std::string title;
  /// Frames shown, evenly spaced from the first to the last; fewer where the motion has fewer.
  int frames = 24;
  int columns = 8;
  int tile_width = 210, tile_height = 250;  ///< pixels, 16 to 4096
  /// Frame numbers that are highlighted. Each takes the place of the evenly spaced frame nearest to
  /// it, or comes in addition where another key has that place.
  std::vector<int64_t> key_frames;
  /// Each row is a motion of its own: times begin again with it, and what is said of the whole
  /// (length, frame numbers) is left out. `frames` and `columns` must cut the motion so.
  bool rows_apart = false;
  /// What stands below each frame in place of its time, one a frame of the motion; the length of
  /// the whole is then left out. Empty: times.
  std::vector<std::string> captions;
};

/// Draws dancers (stage.h) as rows of frames, in time from left to right, into a PNG. All frames
/// are seen from one side; the camera goes along with the dancers over a floor whose grid stands
/// still. Throws Error(kInvalidArgument) as CheckStage, for a key frame that they do not have,
/// another count of captions than of frames, or sizes outside their limits; Error(kInternal) where
/// the file cannot be written. Thread-safe.
void DrawContactSheet(const Stage& stage, const ContactSheetOptions& options,
                      const std::filesystem::path& png);

/// The frames that a sheet of `total` frames shows, in order, each once; and which are keys.
struct SheetFrame {
  int64_t frame = 0;
  bool key = false;
};
std::vector<SheetFrame> ChooseSheetFrames(int64_t total, const ContactSheetOptions& options);

}  // namespace choreo
