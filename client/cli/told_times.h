#pragma once

#include <cstdint>
#include <string>

#include "client/authoring/counts.h"
#include "model/core/grid.h"

namespace choreo::cli {

/// How moments of a dance are told to users: in the unit that they use.
struct ToldTimes {
  double fps = kModelFps;         ///< the model's
  authoring::Counts counts = {};  ///< of the song; empty: seconds alone

  /// "4.2 s", or "9c, 4.2 s".
  std::string Of(int64_t frame) const;
};

}  // namespace choreo::cli
