#include "model/flow/priors/energy_prior.h"

#include <gtest/gtest.h>

#include <cmath>

namespace choreo::energy_prior_test {

using Levels = EnergyPrior::Levels;

TEST(EnergyPrior, RoundTripsThroughItsNumbers) {
  EnergyPrior prior(3);
  prior.most.setRandom();
  prior.usual_way.setRandom();
  prior.usual_way_in_world.setRandom();
  prior.styles.setRandom();
  prior.keyed.setRandom();
  prior.free.setRandom();
  prior.spread.setRandom();
  EnergyPrior back(3);
  back.SetNumbers(prior.ToNumbers());
  EXPECT_EQ(back.keyed, prior.keyed);
  EXPECT_EQ(back.free, prior.free);
  EXPECT_EQ(back.spread, prior.spread);
  EXPECT_EQ(back.most, prior.most);
  EXPECT_EQ(back.usual_way, prior.usual_way);
  EXPECT_EQ(back.usual_way_in_world, prior.usual_way_in_world);
  EXPECT_EQ(back.styles, prior.styles);
}

TEST(EnergyPrior, UntrainedGivesTheMedianEnergy) {
  EXPECT_EQ(EnergyPrior().Sample({.surprise = 3}, Levels::Ones()), Levels::Zero());
}

TEST(EnergyPrior, AppliesWeightsOfKeyDistanceAndHistory) {
  EnergyPrior prior;
  prior.keyed(1, 1) = 0.5;   // surprise → left arm
  prior.keyed(2, 4) = 0.25;  // what the right arm did → right arm
  prior.free(2, 4) = 0.25;   // counts nothing
  prior.spread(1, 1) = 0.1;
  const EnergyPrior::Known known{
      .key = true, .surprise = std::exp(2.0), .history = Levels::Constant(4), .frames = 60};
  EXPECT_NEAR(prior.Sample(known, Levels::Zero())[1], 1, 1e-12);
  EXPECT_NEAR(prior.Sample(known, Levels::Ones())[1], 1.1, 1e-12);
  EXPECT_NEAR(prior.Sample(known, Levels::Zero())[2], 1, 1e-12);
  EnergyPrior::Known free = known;
  free.key = false;
  EXPECT_EQ(prior.Sample(free, Levels::Zero())[2], 0) << "a dance does not follow itself";
}

TEST(EnergyPrior, UnknownDistancesAreTheUsualOnes) {
  EnergyPrior prior;
  constexpr int kWay = EnergyPrior::kHistoryInput + kBodyParts, kInWorld = kWay + kBodyParts;
  prior.keyed(3, kWay + 3) = 0.5;
  prior.keyed(3, kInWorld + 3) = 0.25;
  prior.usual_way.setConstant(2);
  prior.usual_way_in_world.setConstant(4);
  EnergyPrior::Known known{.key = true};
  EXPECT_NEAR(prior.Sample(known, Levels::Zero())[3], 2, 1e-12);
  known.way = Levels::Constant(6);
  EXPECT_NEAR(prior.Sample(known, Levels::Zero())[3], 4, 1e-12);
  known.way_in_world = Levels::Zero();
  EXPECT_NEAR(prior.Sample(known, Levels::Zero())[3], 3, 1e-12);
}

TEST(EnergyPrior, ClampsInputsToTheTrainingRange) {
  EnergyPrior prior;
  prior.keyed(1, 1) = 1;
  prior.spread.setIdentity();
  prior.most[1] = 2;                                 // of the surprise
  prior.most[EnergyPrior::kHistoryInput + 1] = 2.5;  // of the left arm
  const EnergyPrior::Known far{.key = true, .surprise = std::exp(7.0)};
  EXPECT_NEAR(prior.Sample(far, Levels::Zero())[1], 2, 1e-12);
  EXPECT_NEAR(prior.Sample(far, Levels::Ones())[1], 2.5, 1e-12);
}

TEST(EnergyPrior, EnergyDependsOnTheStyle) {
  EnergyPrior prior(2);
  prior.styles(4, 1) = 0.3;
  EXPECT_EQ(prior.Sample({.style = 0}, Levels::Zero())[4], 0);
  EXPECT_EQ(prior.Sample({.style = 1}, Levels::Zero())[4], 0.3);
}

TEST(EnergyPrior, EnergyDependsOnTheWindowsLength) {
  EnergyPrior prior;
  prior.keyed(0, EnergyPrior::kInputs / 2) = -0.5;
  const auto trunk = [&](int frames) {
    return prior.Sample({.key = true, .frames = frames}, Levels::Zero())[0];
  };
  EXPECT_EQ(trunk(60), 0);
  EXPECT_NEAR(trunk(120), -0.5, 1e-12);
  EXPECT_NEAR(trunk(30), 0.5, 1e-12);
}

}  // namespace choreo::energy_prior_test
