#include "model/motion/kinematics/kinematic_beats.h"

#include <gtest/gtest.h>

#include <cmath>

namespace choreo::kinematic_beats_test {

TEST(KinematicBeats, AreMaximaOfSpeed) {
  const std::vector<float> speed = {0, 1, 3, 2, 2, 5, 5, 5, 4, 6};
  // 3 at index 2 and the plateau of 5 from index 5 on; the 6 at the end may still rise.
  constexpr double kUnsmoothed = 1;  // a frame a second: the Gaussian is a twelfth of a frame
  EXPECT_EQ(KinematicBeats(speed, kUnsmoothed), (std::vector<int64_t>{3, 6}));
  EXPECT_TRUE(KinematicBeats({}, kUnsmoothed).empty());
  const std::vector<float> falling = {3, 2, 1};
  EXPECT_TRUE(KinematicBeats(falling, kUnsmoothed).empty());
}

TEST(KinematicBeats, IgnoreShaking) {
  std::vector<float> speed;
  for (int i = 0; i < 120; ++i) {
    const double sway = std::cos(2 * 3.14159265358979 * (i - 20) / 30);
    speed.push_back(static_cast<float>(1 + sway + (i % 2 == 0 ? 0.2 : -0.2)));
  }
  const std::vector<int64_t> beats = KinematicBeats(speed, 30);
  ASSERT_EQ(beats.size(), 4U);
  for (size_t i = 0; i < beats.size(); ++i)
    EXPECT_NEAR(static_cast<double>(beats[i]), 21.0 + 30.0 * static_cast<double>(i), 1);
}

}  // namespace choreo::kinematic_beats_test
