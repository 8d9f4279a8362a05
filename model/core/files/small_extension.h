#pragma once

#include <filesystem>
#include <string>

namespace choreo {

/// A path's extension in lower case: ".npz" for "DANCE.NPZ".
inline std::string SmallExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace choreo
