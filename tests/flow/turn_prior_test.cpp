#include "model/flow/window/turn_prior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/core/numbers/random.h"
#include "tests/flow/turn_scene.h"

namespace choreo::turn_prior_test {

using namespace testing_support;

double YawOf(const TurnPrior& prior, const WindowRequest& request, double normal = 0,
             double temperature = 0) {
  return prior.Sample(Body(), request, normal, temperature)->y();
}

TEST(TurnPrior, TurnsTheShorterWayUnlessAlreadyTurningTheOther) {
  EXPECT_NEAR(YawOf(GoesOn(), To(2)), 2, 1e-9);
  EXPECT_NEAR(YawOf(GoesOn(), To(2, 0.1)), 2, 1e-9);
  EXPECT_NEAR(YawOf(GoesOn(), To(2, -0.2)), 2 - 2 * kPi, 1e-9);
  EXPECT_NEAR(YawOf(GoesOn(), To(-2, 0.2)), 2 * kPi - 2, 1e-9);
}

TEST(TurnPrior, MirroredDancerTurnsTheOtherWay) {
  for (const double yaw : {0.3, 1.5, 3.0}) {
    for (const double rate : {-0.2, -0.05, 0.0, 0.1}) {
      const auto one = TurnPrior::Describe(Body(), To(yaw, rate));
      const auto other = TurnPrior::Describe(Body(), To(-yaw, -rate));
      ASSERT_TRUE(one && other);
      EXPECT_TRUE(one->isApprox(*other, 1e-9)) << yaw << ' ' << rate;
    }
  }
}

TEST(TurnPrior, SamplesEachDirectionByItsProbability) {
  const WindowRequest request = To(2.6, -0.02);
  const double chance = GoesOn().ChanceOfOther(*TurnPrior::Describe(Body(), request));
  ASSERT_GT(chance, 0.2);
  ASSERT_LT(chance, 0.8);
  Random random(1);
  int others = 0;
  for (int i = 0; i < 4000; ++i) others += YawOf(GoesOn(), request, random.Normal(), 1) < 0;
  EXPECT_NEAR(others / 4000.0, chance, 0.03);
}

TEST(TurnPrior, BendingIsNoSomersault) {
  WindowRequest request = To(0);
  request.target->pose.rotations.col(0) = Eigen::Vector3d(1.2, 0.1, 0);
  EXPECT_FALSE(GoesOn().Sample(Body(), request, 3, 1));
}

TEST(TurnPrior, GivesNothingWithoutStatistics) {
  EXPECT_FALSE(TurnPrior().Sample(Body(), To(2), 0, 0));
  EXPECT_FALSE(GoesOn().Sample(Body(), To(0), 0, 0)) << "the axis of no turn is noise";
  WindowRequest open = To(2);
  open.target->mask.joints.assign(24, true);
  open.target->mask.joints[0] = false;
  EXPECT_FALSE(GoesOn().Sample(Body(), open, 0, 0));
  open.target.reset();
  EXPECT_FALSE(GoesOn().Sample(Body(), open, 0, 0));
}

}  // namespace choreo::turn_prior_test
