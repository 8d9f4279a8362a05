#pragma once

#include <cstdint>
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
};

}  // namespace choreo::cli
