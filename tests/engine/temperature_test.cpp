#include "model/engine/temperature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr double kRough = 200;  // m/s^3

TransitionSpec Spec(int frames, float temperature, bool keyed = true) {
  TransitionSpec spec;
  spec.frames = frames;
  spec.temperature = temperature;
  if (keyed) spec.target.emplace();
  return spec;
}

TEST(ShareOfTest, QuickWavesOfLongWaysAreWarmestSlowOnesCool) {
  for (const int frames : {10, 30, 60, 90, 1800}) {
    const TransitionSpec spec = Spec(frames, 0.25F);
    WaveShare slower{0, 0};
    for (int wave = 0; wave < frames / 5; ++wave) {
      const WaveShare here = ShareOf(spec, {kRough}, wave, 24);
      EXPECT_GE(here.temperature, slower.temperature) << frames << " " << wave;
      EXPECT_GE(here.temperature, 0.125F) << frames << " " << wave;  // 0.25 to the power of 1.5
      EXPECT_LE(here.temperature, 1.0F) << frames << " " << wave;
      EXPECT_GE(here.components, std::max(slower.components, 6)) << frames << " " << wave;
      EXPECT_LE(here.components, 24) << frames << " " << wave;
      slower = here;
    }
  }
  // Waves of a tenth of a cycle a frame in ways of several lengths.
  const auto quick = [](int frames) {
    return ShareOf(Spec(frames, 0.25F), {kRough}, frames / 5 - 1, 24).temperature;
  };
  EXPECT_FLOAT_EQ(quick(20), 0.125F);
  EXPECT_LT(quick(30), quick(60));
  EXPECT_LT(quick(60), quick(90));
  EXPECT_FLOAT_EQ(quick(90), quick(300));
}

TEST(ShareOfTest, QuickWavesAreAsLivelyAsTheDancerIsRough) {
  const auto share = [](double roughness, int wave) {
    return ShareOf(Spec(90, 0.25F), {roughness}, wave, 24).temperature;
  };
  EXPECT_FLOAT_EQ(share(200, 17), 1);  // 0.25 to the power of 0
  EXPECT_FLOAT_EQ(share(1000, 17), 1);
  EXPECT_FLOAT_EQ(share(5, 17), 0.125F);  // as slow ones
  EXPECT_FLOAT_EQ(share(1, 17), 0.125F);
  EXPECT_NEAR(share(std::sqrt(1000.0), 17), 0.125 * std::sqrt(8.0), 1e-6);
  EXPECT_LT(share(30, 5), share(60, 5));
}

TEST(ShareOfTest, QuickWavesOfLongWaysHaveMostComponents) {
  const auto components = [](int frames, int wave, float temperature) {
    return ShareOf(Spec(frames, temperature), {kRough}, wave, 24).components;
  };
  EXPECT_EQ(components(25, 4, 0.25F), 6);
  EXPECT_EQ(components(60, 0, 0.25F), 13);
  EXPECT_EQ(components(90, 0, 0.25F), 10);
  EXPECT_EQ(components(90, 17, 0.25F), 24);
  EXPECT_EQ(components(90, 17, 0.5F), 24);
  EXPECT_EQ(components(90, 17, 0.75F), 15);
  EXPECT_EQ(components(90, 17, 1), 6);
}

TEST(ShareOfTest, IsTheTemperatureAtZeroAndFromOneOn) {
  for (const int wave : {0, 3, 17}) {
    const auto share = [wave](float temperature) {
      return ShareOf(Spec(90, temperature), {kRough}, wave, 24).temperature;
    };
    EXPECT_EQ(share(0), 0);
    EXPECT_EQ(share(1), 1);
    EXPECT_EQ(share(1.7F), 1.7F);
    EXPECT_NEAR(share(0.9999F), 1, 1e-3);
    for (float temperature = 0.01F; temperature < 1; temperature += 0.01F)
      EXPECT_GE(share(temperature), share(temperature - 0.01F)) << temperature;
    EXPECT_LT(share(0.01F), 0.01F);
  }
}

TEST(ShareOfTest, WhatHasItsWholeSpreadDiffersInFewThings) {
  for (const int wave : {0, 3, 17}) {
    EXPECT_EQ(ShareOf(Spec(90, 1), {kRough}, wave, 24).components, 6);
    EXPECT_EQ(ShareOf(Spec(90, 2), {kRough}, wave, 24).components, 6);
    EXPECT_EQ(ShareOf(Spec(90, 1), {kRough}, wave, 3).components, 1);  // rounded up
  }
}

TEST(ShareOfTest, IsTheRootOfTheTemperatureAndUpToTwiceThatWhereNoKeyHoldsTheDance) {
  TransitionSpec nothing = Spec(150, 0.0625F);
  nothing.target->mask = {.root_position = false, .joints = std::vector<bool>(24, false)};
  for (const TransitionSpec& spec : {Spec(150, 0.0625F, false), nothing}) {
    float slower = 0;
    for (int wave = 0; wave < 30; ++wave) {
      const WaveShare share = ShareOf(spec, {kRough}, wave, 24);
      EXPECT_GE(share.temperature, slower);
      EXPECT_EQ(share.components, 24);
      slower = share.temperature;
    }
    EXPECT_FLOAT_EQ(ShareOf(spec, {kRough}, 0, 24).temperature, 0.25F);
    EXPECT_FLOAT_EQ(slower, 0.5F);
  }
  EXPECT_EQ(ShareOf(Spec(150, 0.5, false), {kRough}, 29, 24).temperature, 1);  // at most all
}

TEST(ShareOfTest, IdleWaysAreLikeThoseWithoutAKey) {
  const TransitionSpec free = Spec(30, 0.25F, false), keyed = Spec(30, 0.25F);
  for (const int wave : {0, 5}) {
    const auto idle = [&](double idleness) {
      return ShareOf(keyed, {.roughness = 5, .idleness = idleness}, wave, 24);
    };
    // Its waves lie between those of a dance that swings freely at its end.
    EXPECT_GE(idle(1).temperature, ShareOf(free, {kRough}, wave, 24).temperature);
    EXPECT_LE(idle(1).temperature, ShareOf(free, {kRough}, wave + 1, 24).temperature);
    EXPECT_EQ(idle(1).components, 24);
    EXPECT_LT(idle(0).temperature, idle(0.5).temperature);
    EXPECT_LT(idle(0.5).temperature, idle(1).temperature);
    EXPECT_EQ(idle(0.5).components, 15);
  }
  // A temperature of one means the same to all keys.
  EXPECT_EQ(ShareOf(Spec(30, 1), {kRough, 1}, 0, 24).temperature, 1);
  EXPECT_EQ(ShareOf(Spec(30, 1), {kRough, 1}, 0, 24).components, 6);
  EXPECT_EQ(ShareOf(Spec(30, 0), {kRough, 1}, 0, 24).temperature, 0);
}

TEST(IdlenessTest, IsOneAtTheSamePoseAndFallsWithTheSpeedAsked) {
  const Skeleton skeleton = Skeleton::Smpl24();
  TransitionSpec spec = Spec(60, 0.25F);
  spec.history = {RestPose(skeleton)};
  spec.target->pose = spec.history[0];
  EXPECT_EQ(Idleness(skeleton, spec), 1);
  spec.target->pose.root_position.x() += 0.05;  // 2.5 cm/s
  EXPECT_NEAR(Idleness(skeleton, spec), 0.75, 1e-9);
  spec.frames = 15;  // 10 cm/s
  EXPECT_NEAR(Idleness(skeleton, spec), 0, 1e-9);
  spec.frames = 1;
  EXPECT_EQ(Idleness(skeleton, spec), 0);
  spec.target.reset();
  EXPECT_EQ(Idleness(skeleton, spec), 0);
}

TEST(IdlenessTest, LooksAtWhatTheKeyNames) {
  const Skeleton skeleton = Skeleton::Smpl24();
  TransitionSpec spec = Spec(60, 0.25F);
  spec.history = {RestPose(skeleton)};
  spec.target->pose = spec.history[0];
  spec.target->pose.root_position.y() += 1;
  spec.target->pose.rotations.col(16).z() += 1.5;  // an arm
  EXPECT_EQ(Idleness(skeleton, spec), 0);
  spec.target->mask = {.root_position = false, .joints = std::vector<bool>(24, false)};
  spec.target->mask.joints[12] = true;  // as it is
  EXPECT_EQ(Idleness(skeleton, spec), 1);
  spec.target->mask.joints[16] = true;
  const double arm = Idleness(skeleton, spec);
  EXPECT_GT(arm, 0);
  EXPECT_LT(arm, 1);
  // A key that names nothing is none.
  spec.target->mask.joints = std::vector<bool>(24, false);
  EXPECT_EQ(Idleness(skeleton, spec), 0);
}

// Ten poses whose joints have the jerk `jerk` m/s^3 along X, and move besides.
std::vector<Pose> WithJerk(double jerk) {
  std::vector<Pose> history(10, RestPose(Skeleton::Smpl24()));
  for (int t = 0; t < 10; ++t) {
    const double s = t / 30.0;
    history[static_cast<size_t>(t)].root_position +=
        Eigen::Vector3d(jerk * s * s * s / 6 + 2 * s, 0.3 * s * s, 0);
  }
  return history;
}

TEST(RoughnessTest, IsTheMedianJerk) {
  EXPECT_NEAR(Roughness(Skeleton::Smpl24(), WithJerk(80)), 80, 1e-6);
  // Both hands alone: most joints are smooth.
  std::vector<Pose> history = WithJerk(10);
  for (size_t t = 0; t < history.size(); t += 2) history[t].rotations.col(20).setConstant(0.5);
  EXPECT_NEAR(Roughness(Skeleton::Smpl24(), history), 10, 1e-6);
}

TEST(RoughnessTest, IsThatOfTheModelsOwnNoiseWhereNothingIsKnown) {
  const double own = std::hypot(50, 65);
  const std::vector<Pose> history = WithJerk(200);
  EXPECT_DOUBLE_EQ(Roughness(Skeleton::Smpl24(), {history.data(), 3}), own);
  // One pose, ten times: a standstill, or a past of which nothing else is said.
  EXPECT_DOUBLE_EQ(Roughness(Skeleton::Smpl24(), std::vector(10, history[7])), own);
  EXPECT_NEAR(NoiseShare(Spec(60, 0.25F), own), 1, 1e-6);
}

TEST(NoiseShareTest, IsAsRoughAsTheDancer) {
  const auto share = [](double jerk) { return NoiseShare(Spec(60, 0.25F), jerk); };
  EXPECT_EQ(share(1), 0);
  EXPECT_EQ(share(49), 0);  // plans have that themselves
  EXPECT_NEAR(share(std::hypot(50, 130)), 2, 1e-4);
  EXPECT_EQ(share(1e5), 3);
}

TEST(NoiseShareTest, OfHighTemperaturesDoesNotGrowFromTransitionToTransition) {
  const auto share = [](float temperature) { return NoiseShare(Spec(60, temperature), 1e5); };
  EXPECT_FLOAT_EQ(share(0.5F), 1.5F);
  EXPECT_EQ(share(1), 1);
  EXPECT_EQ(share(2), 1);
  EXPECT_EQ(NoiseShare(Spec(60, 1), 10), 0);
}

TEST(NoiseShareTest, CountsToAPowerOnShortWays) {
  const auto share = [](int frames, double jerk) {
    return NoiseShare(Spec(frames, 0.25F), std::hypot(50, 65 * jerk));
  };
  for (const double jerk : {0.3, 1.0, 2.5}) {
    EXPECT_NEAR(share(10, jerk), std::pow(jerk, 2.25), 1e-5);
    EXPECT_NEAR(share(2, jerk), std::pow(jerk, 2.25), 1e-5);
    EXPECT_NEAR(share(35, jerk), std::pow(jerk, 1.3125), 1e-5);
    EXPECT_NEAR(share(60, jerk), jerk, 1e-5);
    EXPECT_NEAR(share(300, jerk), jerk, 1e-5);
  }
  EXPECT_NEAR(share(10, 100), std::pow(3, 2.25), 1e-4);
}

TEST(NoiseShareTest, IsOneAtMostWithoutAKey) {
  const auto share = [](int frames, double jerk) {
    return NoiseShare(Spec(frames, 0.25F, false), jerk);
  };
  EXPECT_EQ(share(60, 1000), 1);
  EXPECT_EQ(share(60, 49), 0);
  for (const int frames : {10, 60}) EXPECT_NEAR(share(frames, std::hypot(50, 26)), 0.4, 1e-5);
}

}  // namespace
}  // namespace choreo
