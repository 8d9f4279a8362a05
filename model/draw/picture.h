#pragma once

#include <cstdint>
#include <vector>

namespace choreo {

inline constexpr int kMaxPicturePixels = 32767;  ///< per side: cairo's own limit

/// An 8-bit sRGB picture.
struct Picture {
  int width = 0, height = 0;  ///< pixels
  std::vector<uint8_t> rgb;   ///< [height, width, 3], rows from top to bottom
};

}  // namespace choreo
