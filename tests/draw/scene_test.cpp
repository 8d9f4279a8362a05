#include "model/draw/scene.h"

#include <gtest/gtest.h>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/support/expect_error.h"

namespace choreo::scene_test {

const Skeleton& kSmpl = Skeleton::Smpl24();

SkeletonMotion At(double x, double z, size_t frames) {
  SkeletonMotion dancer{kSmpl, {.fps = 30, .frames = std::vector<Pose>(frames, RestPose(kSmpl))}};
  for (Pose& pose : dancer.motion.frames) pose.root_position += Eigen::Vector3d(x, 0, z);
  return dancer;
}

TEST(Scene, EverybodyIsSeenFromTheFront) {
  constexpr int kWidth = 640, kHeight = 360;
  for (const double wide : {0.8, 2.0, 6.0}) {
    const Scene scene = {At(-wide, 0, 2), At(0, 1, 5), At(wide, -1, 3)};
    EXPECT_EQ(CountFrames(scene), 5);
    const View view = ViewsOf(scene, {{4, MiddleOf(scene, 4)}}, double{kWidth} / kHeight).at(0);
    EXPECT_EQ(view.azimuth, 0);
    EXPECT_NEAR(view.target.x(), 0, 1e-9);
    const Camera camera(view, kWidth, kHeight);
    const std::vector<PlacedPart> dolls = DollsAt(scene, 4);
    EXPECT_EQ(dolls.size(), 3 * BuildDoll(kSmpl, RestPose(kSmpl)).size());
    for (const PlacedPart& part : dolls) {
      for (const auto& [ball, radius] : {std::pair(part.shape.a, part.shape.radius_a),
                                         std::pair(part.shape.b, part.shape.radius_b)}) {
        const Eigen::AlignedBox2f seen = camera.Bounds(ball, radius);
        EXPECT_GT(seen.min().x(), 0) << wide;
        EXPECT_GT(seen.min().y(), 0) << wide;
        EXPECT_LT(seen.max().x(), kWidth) << wide;
        EXPECT_LT(seen.max().y(), kHeight) << wide;
      }
    }
  }
}

/// Turns left by a quarter every second; faces +X at first.
Scene Turning() {
  Scene scene = {At(0, 0, 120)};
  for (size_t i = 0; i < 120; ++i) {
    const double heading = M_PI / 2 * (1 + static_cast<double>(i) / 30);
    scene[0].motion.frames[i].rotations.col(0) = Eigen::Vector3d(0, WrapAngle(heading), 0);
  }
  return scene;
}

TEST(Scene, CamerasAreOnTheRequestedSide) {
  const Scene scene = Turning();
  const auto azimuth = [&](std::optional<CameraSide> side, int64_t frame) {
    return ViewsOf(scene, {{frame, {0, 0}}}, 1, side).at(0).azimuth;
  };
  EXPECT_NEAR(azimuth(CameraSide::kFront, 60), M_PI / 2, 1e-9);
  EXPECT_NEAR(azimuth(CameraSide::kSide, 60), M_PI, 1e-9);
  EXPECT_NEAR(azimuth(CameraSide::kBack, 60), -M_PI / 2, 1e-9);
  EXPECT_NEAR(azimuth(CameraSide::kThreeQuarter, 60), M_PI / 2 + kThreeQuarters, 1e-9);
  EXPECT_EQ(azimuth({}, 60), azimuth(CameraSide::kThreeQuarter, 60));
  for (const int64_t frame : {56, 60, 64}) {
    const double heading = M_PI / 2 * (1 + static_cast<double>(frame) / 30);
    EXPECT_NEAR(WrapAngle(azimuth(CameraSide::kFollow, frame) - heading), kThreeQuarters, 0.01);
  }
  EXPECT_EQ(FindCamera("side"), CameraSide::kSide);
  ExpectError(ErrorCode::kInvalidArgument,
              "camera: \"above\" is none of front, three-quarter, side, back, follow",
              [] { FindCamera("above"); });
}

TEST(Scene, SeveralAreSeenFromASideOfTheStage) {
  const Scene scene = {At(-1, 0, 2), At(1, 0, 2)};
  const std::vector<FramedScene> frames = {{0, {0, 0}}};
  EXPECT_NEAR(ViewsOf(scene, frames, 1, CameraSide::kBack).at(0).azimuth, M_PI, 1e-9);
  EXPECT_LT(ViewsOf(scene, frames, 1, CameraSide::kSide).at(0).extent,
            ViewsOf(scene, frames, 1).at(0).extent);
  ExpectError(ErrorCode::kInvalidArgument, "camera: follow turns with one dancer",
              [&] { ViewsOf(scene, frames, 1, CameraSide::kFollow); });
}

TEST(Scene, RefusesDancersThatFitNoPicture) {
  ExpectError(ErrorCode::kInvalidArgument, "nobody", [] { CheckScene({}); });
  ExpectError(ErrorCode::kInvalidArgument, "0 frames", [] { CheckScene({At(0, 0, 0)}); });
  Scene scene = {At(0, 0, 2), At(1, 0, 2)};
  scene[1].motion.fps = 60;
  ExpectError(ErrorCode::kInvalidArgument, "motion.fps", [&] { CheckScene(scene); });
}

}  // namespace choreo::scene_test
