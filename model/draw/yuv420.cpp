#include "model/draw/yuv420.h"

#include <array>
#include <cmath>
#include <cstring>

namespace choreo {
namespace {

constexpr int kBits = 16;  // of fractions
constexpr double kRed = 0.2126, kBlue = 0.0722, kGreen = 1 - kRed - kBlue;

constexpr int Fixed(double value) {
  return static_cast<int>(value * (1 << kBits) + (value < 0 ? -0.5 : 0.5));
}

// Weights of red, green and blue in a value that spans `range` of 255 and begins at `zero`.
struct Mix {
  int r, g, b, zero;

  constexpr Mix(double red, double green, double blue, double range, double from)
      : r(Fixed(red * range / 255)),
        g(Fixed(green * range / 255)),
        b(Fixed(blue * range / 255)),
        zero(Fixed(from + 0.5)) {}
  // Converts the sum of 1 << `more` pixels.
  uint8_t Of(int red, int green, int blue, int more = 0) const {
    return static_cast<uint8_t>((r * red + g * green + b * blue + (zero << more)) >>
                                (kBits + more));
  }
};
constexpr Mix kLuma(kRed, kGreen, kBlue, 219, 16);
constexpr double kOfBlue = 0.5 / (1 - kBlue), kOfRed = 0.5 / (1 - kRed);
constexpr Mix kCb(-kRed* kOfBlue, -kGreen* kOfBlue, 0.5, 224, 128);
constexpr Mix kCr(0.5, -kGreen* kOfRed, -kBlue* kOfRed, 224, 128);

}  // namespace

std::vector<uint8_t> Yuv420(const Picture& picture) {
  const auto width = static_cast<size_t>(picture.width);
  const auto height = static_cast<size_t>(picture.height);
  std::vector<uint8_t> planes(width * height * 3 / 2);
  uint8_t *cb = &planes[width * height], *cr = cb + width * height / 4;
  for (size_t y = 0; y < height; y += 2) {
    const uint8_t *upper = &picture.rgb[3 * y * width], *lower = upper + 3 * width;
    uint8_t* luma = &planes[y * width];
    for (size_t x = 0; x < width; x += 2, upper += 6, lower += 6, luma += 2, ++cb, ++cr) {
      // Most of a video is floor, whose pixels equal those to their left. Reuses their chroma.
      if (x > 2 && std::memcmp(upper - 3, upper - 9, 9) == 0 &&
          std::memcmp(lower - 3, lower - 9, 9) == 0) {
        std::memcpy(luma, luma - 2, 2), std::memcpy(luma + width, luma + width - 2, 2);
        *cb = cb[-1], *cr = cr[-1];
        continue;
      }
      std::array<int, 3> sum{};
      for (const auto& [rgb, to] : {std::pair(upper, luma), std::pair(lower, luma + width)}) {
        to[0] = kLuma.Of(rgb[0], rgb[1], rgb[2]), to[1] = kLuma.Of(rgb[3], rgb[4], rgb[5]);
        const uint8_t* before = x > 0 ? rgb - 3 : rgb;
        for (size_t i = 0; i < 3; ++i) sum[i] += before[i] + 2 * rgb[i] + rgb[i + 3];
      }
      *cb = kCb.Of(sum[0], sum[1], sum[2], 3), *cr = kCr.Of(sum[0], sum[1], sum[2], 3);
    }
  }
  return planes;
}

}  // namespace choreo
