#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/draw/render.h"
#include "model/draw/scene.h"

namespace choreo {

inline constexpr int kMaxSheetFrames = 10'000, kMaxSheetColumns = 100;

struct ContactSheetOptions {
  std::string title;
  /// The number of frames shown, evenly spaced from the first to the last; all if there are fewer.
  int frames = 24;
  /// If not 0, replaces `frames`: shows every `step`-th frame of the motion, at least 1, from the
  /// first on.
  double step = 0;
  int columns = 8;
  int tile_width = 210, tile_height = 250;  ///< pixels, 16 to 4096
  std::optional<CameraSide> side;           ///< as in ViewsOf
  /// Frames to highlight. Each replaces the nearest evenly spaced frame, or is added if another key
  /// replaced that frame.
  std::vector<int64_t> key_frames;
  /// Treats each row as a motion of its own: times restart in each row, and length and frame
  /// numbers of the whole are omitted. `frames` and `columns` must match.
  bool rows_apart = false;
  /// Captions below the frames in place of times, one per frame of the motion; the total length is
  /// then omitted. Empty: times.
  std::vector<std::string> captions;
  double first_s = 0;  ///< the time of the first frame, seconds
};

/// Draws dancers (scene.h) into a PNG as rows of frames, time running from left to right. The
/// camera moves with the dancers over a fixed floor grid. The heading says how many frames a second
/// are shown. Throws what CheckScene and ViewsOf throw;
/// Error(kInvalidArgument) for a key frame outside the motion, a caption count other than the frame
/// count, or sizes outside their limits; Error(kInternal) if the file cannot be written.
/// Thread-safe.
void DrawContactSheet(const Scene& scene, const ContactSheetOptions& options,
                      const std::filesystem::path& png);

/// A frame that a sheet shows.
struct SheetFrame {
  int64_t frame = 0;
  bool key = false;
};
/// The frames of a sheet for a motion of `total` frames, in order, each once.
std::vector<SheetFrame> ChooseSheetFrames(int64_t total, const ContactSheetOptions& options);

}  // namespace choreo
