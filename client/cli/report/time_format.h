#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "client/authoring/fields/counts.h"
#include "model/core/grid.h"

namespace choreo::cli {

/// Formats moments of a dance for users, in the units that they use.
struct TimeFormat {
  double fps = kModelFps;         ///< the model's
  authoring::Counts counts = {};  ///< of the song; empty: only seconds

  /// "4.2 s", or "9c, 4.2 s".
  std::string Of(int64_t frame) const;
  double Second(int64_t frame) const { return static_cast<double>(frame) / fps; }
  /// The count at a frame, a quarter count if the frame is the nearest to it. None without counts,
  /// and before count 0.
  std::optional<double> Count(int64_t frame) const;
};

}  // namespace choreo::cli
