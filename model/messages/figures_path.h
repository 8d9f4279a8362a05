#pragma once

#include <filesystem>

namespace choreo {

/// The file of a checkpoint's StyleFigures: NAME.figures.json beside NAME.safetensors.
inline std::filesystem::path StyleFiguresFile(std::filesystem::path checkpoint) {
  return checkpoint.replace_extension(".figures.json");
}

}  // namespace choreo
