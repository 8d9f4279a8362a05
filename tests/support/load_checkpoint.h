#pragma once

#include <filesystem>

#include "model/core/files/safetensors.h"
#include "model/papers/networks/flow_checkpoint.h"

namespace choreo {

inline Checkpoint LoadCheckpoint(const std::filesystem::path& path) {
  return ParseCheckpoint(ReadSafetensors(path), path.string());
}

}  // namespace choreo
