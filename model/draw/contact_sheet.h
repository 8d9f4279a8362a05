#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/draw/render.h"
#include "model/draw/stage.h"

namespace choreo {

inline constexpr int kMaxSheetFrames = 10'000, kMaxSheetColumns = 100;

struct ContactSheetOptions {
  std::string title;
  /// Frames shown, evenly spaced from the first to the last, or all if there are fewer.
  int frames = 24;
  int columns = 8;
  int tile_width = 210, tile_height = 250;  ///< pixels, 16 to 4096
  std::optional<CameraSide> side;           ///< as in ViewsOf
  /// Frame numbers to highlight. Each replaces the nearest evenly spaced frame, or is added if
  /// another key has already replaced that.
  std::vector<int64_t> key_frames;
  /// Each row is a motion of its own: times restart in each row, and facts about the whole (length,
  /// frame numbers) are omitted. `frames` and `columns` must match.
  bool rows_apart = false;
  /// Captions below the frames instead of times, one per frame of the motion; omits the total
  /// length. Empty: times.
  std::vector<std::string> captions;
  double first_s = 0;  ///< the time of the first frame
};

/// Draws dancers (stage.h) as rows of frames, in time from left to right, into a PNG. The camera
/// moves with the dancers over a fixed floor grid. Throws what CheckStage and ViewsOf throw;
/// Error(kInvalidArgument) for a key frame outside the motion, a caption count other than the frame
/// count, or sizes outside their limits; Error(kInternal) if the file cannot be written.
/// Thread-safe.
void DrawContactSheet(const Stage& stage, const ContactSheetOptions& options,
                      const std::filesystem::path& png);

/// The frames that a sheet of `total` frames shows, in order, each once, and which are keys.
struct SheetFrame {
  int64_t frame = 0;
  bool key = false;
};
std::vector<SheetFrame> ChooseSheetFrames(int64_t total, const ContactSheetOptions& options);

}  // namespace choreo
