#include "model/training/prepare/recorded_floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace choreo::recorded_floor_test {

constexpr double kPi = std::numbers::pi;

// Two feet that step about on a floor of known slope and height; one stands while the other is
// lifted.
PositionClip Walk(double height, double slope_x, double slope_z, double drift) {
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0, 0.002);
  PositionClip clip;
  clip.fps = 25;
  clip.joint_names = {"left", "right", "head"};
  for (int frame = 0; frame < 1500; ++frame) {
    const double t = frame / clip.fps;
    Eigen::Matrix3Xd positions(3, 3);
    for (int foot = 0; foot < 2; ++foot) {
      const double x = 2 * std::sin(0.31 * t) + 0.2 * foot;
      const double z = 2 * std::cos(0.23 * t);
      const double lift = 0.2 * std::max(0.0, std::sin(2 * kPi * t + kPi * foot));
      positions.col(foot) << x,
          height + slope_x * x + slope_z * z + lift + drift * t / 60 + noise(generator), z;
    }
    positions.col(2) = positions.col(0) + Eigen::Vector3d(0, 1.6, 0);
    clip.frames.push_back(positions);
  }
  return clip;
}

TEST(Floor, FindsSlopeAndHeightUnderADancer) {
  const FloorPlane plane = FitFloorPlane(Walk(0.3, 0.06, -0.04, 0), {0, 1});
  EXPECT_NEAR(plane.slope_x, 0.06, 0.003);
  EXPECT_NEAR(plane.slope_z, -0.04, 0.003);
  EXPECT_NEAR(plane.height, 0.3, 0.01);
}

TEST(Floor, LevellingIsRigidAndMakesItHorizontal) {
  const PositionClip walk = Walk(0.3, 0.06, -0.04, 0);
  const PositionClip level = LevelFloor(walk, FitFloorPlane(walk, {0, 1}));
  const FloorPlane plane = FitFloorPlane(level, {0, 1});
  EXPECT_NEAR(plane.slope_x, 0, 1e-3);
  EXPECT_NEAR(plane.slope_z, 0, 1e-3);
  EXPECT_NEAR(plane.height, 0, 1e-3);
  for (const size_t frame : {0, 700}) {
    EXPECT_NEAR((level.frames[frame].col(2) - level.frames[frame].col(1)).norm(),
                (walk.frames[frame].col(2) - walk.frames[frame].col(1)).norm(), 1e-9);
  }
}

TEST(Floor, DancerOnTheSpotGivesNoSlope) {
  PositionClip clip = Walk(0.3, 0, 0, 0);
  for (Eigen::Matrix3Xd& frame : clip.frames) frame.row(0) *= 0.05;
  const FloorPlane plane = FitFloorPlane(clip, {0, 1});
  EXPECT_EQ(plane.slope_x, 0);
  EXPECT_EQ(plane.slope_z, 0);
  EXPECT_NEAR(plane.height, 0.3, 0.01);
}

TEST(Floor, RemovesDriftAndKeepsJumps) {
  PositionClip walk = Walk(0, 0, 0, 0.25);
  for (int frame = 700; frame < 715; ++frame) walk.frames[frame].row(1).array() += 0.3;
  const PositionClip steady = RemoveHeightDrift(walk, {0, 1});
  for (int frame = 150; frame < 1350; ++frame) {
    const double lowest = std::min(steady.frames[frame](1, 0), steady.frames[frame](1, 1));
    const bool jumps = frame >= 700 && frame < 715;
    EXPECT_NEAR(lowest, jumps ? 0.3 : 0.0, 0.03) << frame;
  }
}

}  // namespace choreo::recorded_floor_test
