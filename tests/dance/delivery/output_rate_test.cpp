#include "model/dance/delivery/output_rate.h"

#include <gtest/gtest.h>

#include "model/motion/resample.h"
#include "tests/dance/poses.h"

namespace choreo::output_rate_test {

std::vector<DanceFrame> Frames(int count) {
  std::mt19937 random(1);
  std::vector<DanceFrame> frames;
  for (const Pose& pose : MotionTo(RandomPose(random), count, random, 0.03)) {
    frames.push_back({RoundToFloat(pose), {static_cast<float>(frames.size()), 0, 0, 0}, 0});
  }
  return frames;
}

TEST(OutputRate, TheModelsOwnRatePassesThrough) {
  const std::vector<DanceFrame> frames = Frames(20);
  OutputRate rate(30, 30, 7, std::nullopt);
  for (size_t i = 0; i < frames.size(); ++i) {
    const OutputFrames out = rate.Push(frames[i]);
    EXPECT_EQ(out.first_frame, static_cast<int64_t>(i) + 7);
    ASSERT_EQ(out.poses.size(), 1u);
    EXPECT_TRUE(SameBits(out.poses[0], frames[i].pose));
    EXPECT_EQ(out.contacts[0], frames[i].contacts);
  }
}

TEST(OutputRate, FramesAreTheMotionAtTheirTimes) {
  const std::vector<DanceFrame> frames = Frames(100);
  Motion motion;
  for (const DanceFrame& frame : frames) motion.frames.push_back(frame.pose);
  for (double fps : {1.0, 10.0, 23.976, 25.0, 29.97, 60.0, 90.0, 119.5, 120.0}) {
    OutputRate rate(30, fps, 0, std::nullopt);
    int64_t count = 0;
    for (size_t i = 0; i < frames.size(); ++i) {
      const OutputFrames out = rate.Push(frames[i]);
      if (!out.poses.empty()) {
        EXPECT_EQ(out.first_frame, count);
      }
      for (const Pose& pose : out.poses) {
        const double time = static_cast<double>(count++) / fps;
        EXPECT_LE(time, static_cast<double>(i) / 30 + 1e-6);  // no look-ahead beyond this frame
        EXPECT_GT(time, (static_cast<double>(i) - 1) / 30 - 1e-6);  // and none held back
        const PoseError error = ComparePoses(Skeleton::Smpl24(), pose, PoseAt(motion, time));
        EXPECT_LT(error.position_m, 1e-5);
        EXPECT_LT(error.angle_deg, 1e-3);
      }
    }
    EXPECT_EQ(count, static_cast<int64_t>(std::floor(99.0 / 30 * fps + 1e-6)) + 1) << fps;
  }
}

TEST(OutputRate, PartsJoinWithoutASeam) {
  const std::vector<DanceFrame> frames = Frames(60);
  for (double fps : {24.0, 30.0, 47.3, 60.0, 120.0}) {
    OutputRate whole(30, fps, 0, std::nullopt);
    std::vector<OutputFrames> expected;
    for (const DanceFrame& frame : frames) expected.push_back(whole.Push(frame));
    for (size_t cut : {1u, 2u, 17u, 59u}) {
      OutputRate part(30, fps, static_cast<int64_t>(cut), frames[cut - 1].pose);
      for (size_t i = cut; i < frames.size(); ++i) {
        const OutputFrames out = part.Push(frames[i]);
        ASSERT_EQ(out.first_frame, expected[i].first_frame);
        ASSERT_EQ(out.poses.size(), expected[i].poses.size());
        EXPECT_EQ(out.contacts, expected[i].contacts);
        for (size_t j = 0; j < out.poses.size(); ++j) {
          EXPECT_TRUE(SameBits(out.poses[j], expected[i].poses[j]));
        }
      }
    }
  }
}

}  // namespace choreo::output_rate_test
