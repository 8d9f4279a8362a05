#include "model/evaluation/evaluation.h"

#include <gtest/gtest.h>

#include "tests/support/fake_engine.h"
#include "tests/support/synthetic_clips.h"

namespace choreo {
namespace {

using testing_support::SyntheticClip;

TEST(EvaluateTransitions, MeasuresAgainstInterpolationAndHitsTheKeys) {
  FakeEngine engine(1);
  const std::vector<PreparedClip> clips = {SyntheticClip("a", 150, 0.1, true),
                                           SyntheticClip("b", 150, 0.9, false)};
  const TransitionRow row = EvaluateTransitions(engine, clips, 30, 3, 0.3F);
  EXPECT_EQ(row.windows, 6);
  EXPECT_GT(row.interpolation_m, 0.001);
  EXPECT_GT(row.model_m, 0.001);
  EXPECT_GT(row.raw_key_m, 1e-4);  // the fake model misses by a little
  EXPECT_LE(row.final_key_m, 1e-3);
  EXPECT_LE(row.final_key_deg, 0.1);
  // A clip that is too short offers nothing.
  EXPECT_EQ(EvaluateTransitions(engine, clips, 145, 3, 0.3F).windows, 0);
}

TEST(EvaluateTransitions, AStillDancerLeavesNothingToInterpolate) {
  FakeEngine engine(1);
  PreparedClip still = SyntheticClip("still", 100, 0.1, false);
  for (Pose& pose : still.motion.frames) pose = still.motion.frames[0];
  EXPECT_LT(EvaluateTransitions(engine, {still}, 20, 2, 0.0F).interpolation_m, 1e-9);
}

TEST(EvaluateLongDance, SeesAFreezeAndABentKnee) {
  const PreparedClip clip = SyntheticClip("a", 150, 0.1, false);
  const SpeedRange real = MeasureRealSpeeds({clip});
  EXPECT_GT(real.median, 0.01);
  FakeEngine engine(1);
  const LongDanceRow keyed = EvaluateLongDance(engine, clip, 120, 30, 0.3F, 1, real);
  EXPECT_TRUE(keyed.finite);
  EXPECT_GT(keyed.median_speed, 0);
  EXPECT_LE(keyed.worst_key_m, 1e-3);
  // Without keys the fake model settles where it stands.
  const LongDanceRow free_dance = EvaluateLongDance(engine, clip, 120, 0, 0.0F, 1, real);
  EXPECT_LT(free_dance.late_speed, keyed.late_speed);
  PreparedClip bent = clip;
  for (Pose& pose : bent.motion.frames)
    pose.rotations.col(Skeleton::Smpl24().left_knee) = Eigen::Vector3d(-1, 0, 0);
  EXPECT_GT(MeasureRealSpeeds({bent}).bent_backwards, 0.2);
}

}  // namespace
}  // namespace choreo
