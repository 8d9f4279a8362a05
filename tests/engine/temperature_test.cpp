#include "model/engine/temperature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace choreo {
namespace {

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
      const WaveShare here = ShareOf(spec, wave, 24);
      EXPECT_GE(here.temperature, slower.temperature) << frames << " " << wave;
      EXPECT_GE(here.temperature, 0.125F) << frames << " " << wave;  // 0.25 to the power of 1.5
      EXPECT_LE(here.temperature, 0.9F) << frames << " " << wave;
      EXPECT_GE(here.components, std::max(slower.components, 6)) << frames << " " << wave;
      EXPECT_LE(here.components, 24) << frames << " " << wave;
      slower = here;
    }
  }
  // Waves of a tenth of a cycle a frame in ways of several lengths.
  const auto quick = [](int frames) {
    return ShareOf(Spec(frames, 0.25F), frames / 5 - 1, 24).temperature;
  };
  EXPECT_FLOAT_EQ(quick(20), 0.125F);
  EXPECT_LT(quick(30), quick(60));
  EXPECT_LT(quick(60), quick(90));
  EXPECT_FLOAT_EQ(quick(90), quick(300));
  EXPECT_EQ(ShareOf(Spec(90, 0.25F), 17, 24).components, 24);
}

TEST(ShareOfTest, IsTheTemperatureAtZeroAndFromOneOn) {
  for (const int wave : {0, 3, 17}) {
    const auto share = [wave](float temperature) {
      return ShareOf(Spec(90, temperature), wave, 24).temperature;
    };
    EXPECT_EQ(share(0), 0);
    EXPECT_EQ(share(1), 1);
    EXPECT_EQ(share(1.7F), 1.7F);
    EXPECT_NEAR(share(0.9999F), 1, 1e-3);
  }
}

TEST(ShareOfTest, WhatHasItsWholeSpreadDiffersInFewThings) {
  for (const int wave : {0, 3, 17}) {
    EXPECT_EQ(ShareOf(Spec(90, 1), wave, 24).components, 6);
    EXPECT_EQ(ShareOf(Spec(90, 2), wave, 24).components, 6);
    EXPECT_EQ(ShareOf(Spec(90, 1), wave, 3).components, 1);  // rounded up
  }
}

TEST(ShareOfTest, IsTheFourthRootOfAllWhereNoKeyHoldsTheDance) {
  TransitionSpec nothing = Spec(60, 0.0625F);
  nothing.target->mask = {.root_position = false, .joints = std::vector<bool>(24, false)};
  for (const TransitionSpec& spec : {Spec(60, 0.0625F, false), nothing}) {
    for (const int wave : {0, 5, 11}) {
      EXPECT_FLOAT_EQ(ShareOf(spec, wave, 24).temperature, 0.5F);
      EXPECT_EQ(ShareOf(spec, wave, 24).components, 24);
    }
  }
}

// Placements of ten frames whose joints have the jerk `jerk` m/s^3 along X, and move besides.
std::vector<JointPlacement> WithJerk(double jerk) {
  std::vector<JointPlacement> history(10);
  for (int t = 0; t < 10; ++t) {
    const double s = t / 30.0;
    history[static_cast<size_t>(t)].positions = Eigen::Matrix3Xd::Zero(3, 24);
    history[static_cast<size_t>(t)].positions.row(0).setConstant(jerk * s * s * s / 6 + 2 * s);
    history[static_cast<size_t>(t)].positions.row(1).setConstant(0.3 * s * s);
  }
  return history;
}

TEST(NoiseShareTest, IsAsRoughAsTheDancer) {
  const TransitionSpec spec = Spec(60, 0.25F);
  const auto share = [&](double jerk) { return NoiseShare(spec, WithJerk(jerk), 30); };
  EXPECT_EQ(share(1), 0);
  EXPECT_EQ(share(49), 0);  // plans have that themselves
  EXPECT_NEAR(share(std::hypot(50, 65)), 1, 1e-4);
  EXPECT_NEAR(share(std::hypot(50, 130)), 2, 1e-4);
  EXPECT_EQ(share(1e5), 3);
}

TEST(NoiseShareTest, OfHighTemperaturesDoesNotGrowFromTransitionToTransition) {
  const auto share = [&](float temperature) {
    return NoiseShare(Spec(60, temperature), WithJerk(1e5), 30);
  };
  EXPECT_FLOAT_EQ(share(0.5F), 1.5F);
  EXPECT_EQ(share(1), 1);
  EXPECT_EQ(share(2), 1);
  EXPECT_EQ(NoiseShare(Spec(60, 1), WithJerk(10), 30), 0);
}

TEST(NoiseShareTest, IsOneWhereNothingIsKnown) {
  EXPECT_EQ(NoiseShare(Spec(60, 0.25F, false), WithJerk(200), 30), 1);
  const std::vector<JointPlacement> history = WithJerk(200);
  EXPECT_EQ(NoiseShare(Spec(60, 0.25F), {history.data(), 3}, 30), 1);
  // One pose, ten times: a standstill, or a past of which nothing else is said.
  EXPECT_EQ(NoiseShare(Spec(60, 0.25F), std::vector(10, history[7]), 30), 1);
}

}  // namespace
}  // namespace choreo
