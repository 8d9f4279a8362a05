#include "model/draw/yuv420.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace choreo::yuv420_test {

// The colour that a player shows for BT.709 in limited range.
std::array<double, 3> Shown(double luma, double cb, double cr) {
  const double y = (luma - 16) / 219, b = (cb - 128) / 224, r = (cr - 128) / 224;
  const double red = y + 1.5748 * r, blue = y + 1.8556 * b;
  return {255 * red, 255 * (y - 0.2126 * red - 0.0722 * blue) / 0.7152, 255 * blue};
}

TEST(Yuv420, PlayersReproduceTheColours) {
  for (const std::array<uint8_t, 3>& colour : std::vector<std::array<uint8_t, 3>>{
           {0, 0, 0}, {255, 255, 255}, {236, 230, 220}, {217, 154, 0}, {255, 0, 0}, {0, 0, 255}}) {
    Picture picture{.width = 4, .height = 2, .rgb = {}};
    for (int i = 0; i < 8; ++i) picture.rgb.insert(picture.rgb.end(), colour.begin(), colour.end());
    const std::vector<uint8_t> yuv = Yuv420(picture);
    ASSERT_EQ(yuv.size(), 12u);
    for (size_t pixel = 0; pixel < 8; ++pixel) {
      const std::array<double, 3> shown =
          Shown(yuv[pixel], yuv[8 + pixel % 2], yuv[10 + pixel % 2]);
      for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(shown[i], colour[i], 2) << pixel;
    }
  }
}

// Half a pixel further right, as the mean of four would be, colours would leave their shapes.
TEST(Yuv420, ChromaIsThatOfTheLeftColumn) {
  Picture picture{.width = 12, .height = 2, .rgb = std::vector<uint8_t>(72)};
  const auto paint = [&](int column) {
    picture.rgb.assign(72, 9);
    for (const int at : {column, column + 12}) picture.rgb[static_cast<size_t>(3 * at)] = 249;
    const std::vector<uint8_t> yuv = Yuv420(picture);
    return std::vector<int>(yuv.begin() + 30, yuv.end());  // Cr
  };
  const int none = 128, all = static_cast<int>(std::lround(128 + 0.5 * 224 * 240 / 255.0));
  const int half = (none + all + 1) / 2, quarter = (none + half) / 2;
  EXPECT_EQ(paint(4), (std::vector{none, none, half, none, none, none}));
  EXPECT_EQ(paint(5), (std::vector{none, none, quarter, quarter, none, none}));
}

TEST(Yuv420, LumaIsPerPixelAndChromaPerTwoRows) {
  const std::vector<uint8_t> upper = {255, 0, 0, 0, 255, 0, 9, 9, 9, 9, 9, 9},
                             lower = {0, 0, 255, 0, 0, 0, 9, 9, 9, 250, 9, 9};
  Picture picture{.width = 4, .height = 2, .rgb = upper};
  picture.rgb.insert(picture.rgb.end(), lower.begin(), lower.end());
  const std::vector<uint8_t> yuv = Yuv420(picture);
  const auto luma = [](double r, double g, double b) {
    return static_cast<int>(std::lround(16 + 219 * (0.2126 * r + 0.7152 * g + 0.0722 * b) / 255));
  };
  EXPECT_EQ(yuv[0], luma(255, 0, 0));
  EXPECT_EQ(yuv[1], luma(0, 255, 0));
  EXPECT_EQ(yuv[4], luma(0, 0, 255));
  EXPECT_EQ(yuv[5], luma(0, 0, 0));
  EXPECT_EQ(yuv[7], luma(250, 9, 9));
  const auto cr = [](double r, double g, double b) {
    return 128 + 224 * 0.5 / (1 - 0.2126) * (0.7874 * r - 0.7152 * g - 0.0722 * b) / 255;
  };
  EXPECT_NEAR(yuv[10], cr(95.6, 31.9, 95.6), 1);  // of eight 3 are red, 1 green, 3 blue
}

}  // namespace choreo::yuv420_test
