#include "model/dance/delivery/body_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/body_limits.h"

namespace choreo::body_watch_test {

constexpr double kFps = 30;

const Skeleton& Body() { return Skeleton::Smpl24(); }

// Stands, moved by `by`.
Pose At(const Eigen::Vector3d& by) {
  Pose pose = StandingPose(Body());
  pose.root_position += by;
  return pose;
}

TEST(BodyWatch, NamesTheFastestStepOfATransition) {
  BodyWatch watch(Body(), kFps, At({0, 0, 0}));
  watch.StartTransition("kneel", 15);
  watch.Add(7, At({0, 0, 0.2}));
  watch.Add(8, At({0, 0, 0.7}));  // 15 m/s
  watch.Add(9, At({0, 0, 0.8}));
  const std::vector<Warning> warnings = watch.TakeWarnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, Warning::Code::kJointTooFast);
  EXPECT_EQ(warnings[0].frame, 8);
  EXPECT_EQ(warnings[0].key_id, "kneel");
  EXPECT_NEAR(warnings[0].figure, 15, 1e-6);
  EXPECT_EQ(warnings[0].limit, kFastestJoint);
  EXPECT_THAT(warnings[0].message, ::testing::StartsWith("on the way to key \"kneel\" in 0.5 s "));
  EXPECT_THAT(warnings[0].message,
              ::testing::EndsWith(" moves at 15 m/s; people reach 11; 0.68 s would do"));
  // The next transition is judged by its own frames.
  watch.StartTransition("", 15);
  watch.Add(10, At({0, 0, 0.9}));
  EXPECT_TRUE(watch.TakeWarnings().empty());
}

TEST(BodyWatch, AFlightIsToldOnceAcrossTransitions) {
  BodyWatch watch(Body(), kFps, std::nullopt);
  int64_t frame = 0;
  std::vector<Warning> told;
  const auto dance = [&](const std::string& key, int frames, double height) {
    watch.StartTransition(key, frames);
    for (int i = 0; i < frames; ++i) watch.Add(frame++, At({0, height, 0}));
    for (const Warning& warning : watch.TakeWarnings()) told.push_back(warning);
  };
  dance("ready", 20, 0);
  dance("jump", 18, 0.3);
  dance("land", 10, 0);
  EXPECT_TRUE(told.empty());  // 0.6 s
  dance("up", 6, 0.3);
  for (int hold = 0; hold < 4; ++hold) dance("held", 6, 0.3);
  dance("down", 10, 0);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].code, Warning::Code::kFlightTooLong);
  EXPECT_EQ(told[0].frame, 48);
  EXPECT_EQ(told[0].key_id, "held");
  EXPECT_GT(told[0].figure, kLongestFlight);
  EXPECT_EQ(told[0].limit, kLongestFlight);
}

// A dancer who lies, sits or stands on the hands does not fly.
TEST(BodyWatch, HandsOnTheFloorAreNoFlight) {
  Pose pose = RestPose(Body());
  pose.rotations.col(0).x() = M_PI;  // head down
  const double lowest = JointPositions(Body(), pose).row(1).minCoeff();
  pose.root_position.y() += 0.05 - lowest;
  BodyWatch watch(Body(), kFps, pose);
  watch.StartTransition("", 60);
  for (int64_t frame = 0; frame < 60; ++frame) watch.Add(frame, pose);
  EXPECT_TRUE(watch.TakeWarnings().empty());
}

}  // namespace choreo::body_watch_test
