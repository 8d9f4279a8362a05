#pragma once

#include <cstdint>
#include <string>

#include "model/core/grid.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// The first answer: how to interpret the frames.
struct DanceHeader {
  std::string model = {};
  std::string fingerprint = {};
  Skeleton skeleton = {};
  uint64_t seed = 0;
  double temperature = 0;
  double fps = kModelFps;        ///< of the frames received
  double model_fps = kModelFps;  ///< of every other frame number
  int64_t first_frame = 0;
  int latency_frames = 0;
  bool exact_resume = true;        ///< false: resumed from a continuation of another fingerprint
  int free_transition_frames = 0;  ///< of transitions without a key
  std::string server_version = {};
};

}  // namespace choreo
