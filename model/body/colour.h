#pragma once

namespace choreo {

/// A colour in sRGB.
struct Colour {
  double r = 0, g = 0, b = 0;  ///< 0 to 1

  /// Makes a colour from 0xRRGGBB.
  static constexpr Colour Hex(unsigned rgb) {
    return {(rgb >> 16 & 0xff) / 255.0, (rgb >> 8 & 0xff) / 255.0, (rgb & 0xff) / 255.0};
  }
  bool operator==(const Colour&) const = default;
};

}  // namespace choreo
