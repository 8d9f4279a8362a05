#include <gtest/gtest.h>

#include <numbers>

#include "tests/dance/dances.h"
#include "tests/support/turning_sampler.h"

/// Rotations of a dancer who keeps turning.
namespace choreo::turning_test {

constexpr double kStep = 0.2;  // radians a frame
constexpr int64_t kFrames = 300;

Recording Turn(double tilt, double fps, std::optional<Continuation> continuation = {}) {
  std::vector<std::unique_ptr<Sampler>> samplers;
  samplers.push_back(std::make_unique<TurningSampler>(kStep, tilt));
  SampleQueue queue(std::move(samplers), {});
  Dance dance;
  dance.config.output_fps = fps;
  dance.config.end_frame = kFrames;
  dance.config.continuation = std::move(continuation);
  return Perform(queue, dance);
}

class TurningTest : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Tilts, TurningTest, testing::Values(0.0, 0.02, 0.3, 1.4));

TEST_P(TurningTest, QuaternionsKeepTheirSigns) {
  for (const double fps : {30.0, 24.0, 60.0}) {
    const Recording recording = Turn(GetParam(), fps);
    ASSERT_TRUE(recording.summary);
    for (size_t i = 1; i < recording.poses.size(); ++i) {
      for (int joint = 0; joint < 24; ++joint) {
        const Eigen::Quaterniond now = QuaternionFromExp(recording.poses[i].rotations.col(joint));
        const Eigen::Quaterniond before =
            QuaternionFromExp(recording.poses[i - 1].rotations.col(joint));
        ASSERT_GT(now.dot(before), 0) << "frame " << i << ", joint " << joint << " at " << fps;
      }
    }
  }
}

// Other rotation vectors of that quaternion are two turns longer or shorter.
TEST_P(TurningTest, VectorsStayNearThePreviousFrame) {
  const Recording recording = Turn(GetParam(), 30);
  for (size_t i = 1; i < recording.poses.size(); ++i) {
    for (const int joint : {0, Skeleton::Smpl24().left_elbow}) {
      const Eigen::Vector3d now = recording.poses[i].rotations.col(joint);
      const Eigen::Vector3d before = recording.poses[i - 1].rotations.col(joint);
      for (const int turns : {-4, -2, 2, 4}) {
        const Eigen::Vector3d other = now + now.normalized() * (turns * 2 * std::numbers::pi);
        ASSERT_LE((now - before).norm(), (other - before).norm() + 1e-4) << "frame " << i;
      }
    }
  }
}

TEST_P(TurningTest, ResumedVectorsAreTheSame) {
  const Recording whole = Turn(GetParam(), 30);
  ASSERT_GT(whole.continuations.size(), 2U);
  for (const Continuation& continuation : whole.continuations) {
    if (continuation.frame == kFrames) continue;
    const Recording rest = Turn(GetParam(), 30, continuation);
    ASSERT_EQ(rest.poses.size(), static_cast<size_t>(kFrames - continuation.frame));
    for (size_t i = 0; i < rest.poses.size(); ++i) {
      ASSERT_TRUE(
          SameBits(rest.poses[i], whole.poses[static_cast<size_t>(continuation.frame) + i]));
    }
  }
}

// About one axis vectors wind up, and never jump.
TEST(TurningAboutOneAxis, VectorsAreContinuous) {
  const Recording recording = Turn(0, 30);
  for (size_t i = 1; i < recording.poses.size(); ++i) {
    const Eigen::Vector3d change =
        recording.poses[i].rotations.col(0) - recording.poses[i - 1].rotations.col(0);
    ASSERT_NEAR(change.norm(), kStep, 1e-3) << "frame " << i;
  }
  EXPECT_NEAR(recording.poses.back().rotations.col(0).norm(), kStep * kFrames, 1e-2);
}

}  // namespace choreo::turning_test
