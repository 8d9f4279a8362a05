#include "model/draw/floor.h"

#include <gtest/gtest.h>

namespace choreo::floor_test {

// Stretches of one colour are found, not drawn: lines, shadow and fading floor are none of them.
TEST(Floor, RowsShowWhatEachPixelShows) {
  constexpr int kWidth = 321, kHeight = 180;
  const Eigen::Vector3f floor(0.83f, 0.79f, 0.72f), background(0.96f, 0.94f, 0.92f);
  const std::vector<BoundedCone> parts = {BoundedCone(
      {.a = {0.2f, 0.1f, 0}, .b = {0.2f, 0.9f, 0}, .radius_a = 0.1f, .radius_b = 0.1f})};
  const FloorLight light(parts, Eigen::Vector3f(0.4f, 1, 0.3f).normalized(), 0.1f);
  for (const double azimuth : {0.0, 0.6, M_PI / 2}) {
    const View view{.target = {0.3, 0.95, -0.2}, .azimuth = azimuth};
    const Camera camera(view, kWidth, kHeight);
    const Floor drawn(view, camera, light, kWidth, kHeight, floor, background);
    std::vector<uint8_t> row(3 * kWidth);
    int plain = 0, copied = 0;
    for (int y = 0; y < kHeight; ++y) {
      copied += drawn.DrawRow(y, row.data());
      for (int x = 0; x < kWidth; ++x) {
        const Eigen::Array2f centre = Eigen::Array2i(x, y).cast<float>() + 0.5f;
        uint8_t bytes[3];
        Tone().Put(drawn.At(centre, 1), bytes);
        for (int i = 0; i < 3; ++i) ASSERT_NEAR(row[3 * x + i], bytes[i], 1) << x << ", " << y;
        Tone().Put(floor, bytes);
        plain += row[3 * x] == bytes[0];
      }
    }
    EXPECT_GT(plain, kWidth * kHeight / 10);
    EXPECT_GT(copied, kWidth) << "a picture so small has few stretches without lines, but some";
  }
}

}  // namespace choreo::floor_test
