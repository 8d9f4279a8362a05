#include "model/flow/priors/energy_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/core/numbers/random.h"

namespace choreo::energy_curve_test {

using Levels = EnergyPrior::Levels;
constexpr int kFrames = 40;

EnergyCurve Curve() {
  EnergyCurve curve;
  for (int lag = 0; lag < EnergyCurve::kLags; ++lag) curve.correlation[lag] = std::exp(-lag / 10.0);
  curve.spread = 0.5 * decltype(curve.spread)::Identity();
  curve.spread(2, 1) = 0.4;  // the right arm goes with the left
  return curve;
}

Eigen::MatrixXd Normal(uint32_t seed) {
  Random random(seed);
  Eigen::MatrixXd normal(kBodyParts, kFrames);
  for (double& one : normal.reshaped()) one = random.Normal();
  return normal;
}

TEST(EnergyCurve, RoundTripsThroughItsNumbers) {
  const EnergyCurve curve = Curve(), back = EnergyCurve::FromNumbers(curve.ToNumbers());
  EXPECT_EQ(curve.ToNumbers().size(), size_t{EnergyCurve::kNumbers});
  EXPECT_EQ(back.correlation, curve.correlation);
  EXPECT_EQ(back.spread, curve.spread);
  EXPECT_TRUE(back.known());
  EXPECT_FALSE(EnergyCurve().known());
}

TEST(EnergyCurve, SamplesHaveTheGivenSpreadAndCorrelation) {
  const EnergyCurve curve = Curve();
  constexpr int kSamples = 2000;
  double square = 0, later = 0, arms = 0;
  for (uint32_t seed = 1; seed <= kSamples; ++seed) {
    const Eigen::MatrixXd levels = curve.Sample(Levels::Zero(), Normal(seed));
    square += levels(1, 25) * levels(1, 25) / kSamples;
    later += levels(1, 25) * levels(1, 35) / kSamples;
    arms += levels(1, 25) * levels(2, 25) / kSamples;
  }
  EXPECT_NEAR(square, 0.25, 0.03);
  EXPECT_NEAR(later / square, std::exp(-1.0), 0.06);
  EXPECT_NEAR(arms, 0.2, 0.03);
}

TEST(EnergyCurve, StartsAtTheHistorysLevelAndForgetsIt) {
  const Eigen::MatrixXd calm =
      Curve().Sample(Levels::Constant(-1), Eigen::MatrixXd::Zero(kBodyParts, kFrames));
  EXPECT_NEAR(calm(0, 0), -std::exp(-0.5), 1e-9);
  EXPECT_NEAR(calm(0, 20), -std::exp(-2.5), 1e-9);
}

TEST(EnergyCurve, RandomNumbersDoNotChangeEarlierFrames) {
  Eigen::MatrixXd normal = Normal(1);
  const Eigen::MatrixXd before = Curve().Sample(Levels::Zero(), normal);
  normal(0, 30) += 1;
  const Eigen::MatrixXd after = Curve().Sample(Levels::Zero(), normal);
  EXPECT_EQ(before.leftCols(30), after.leftCols(30));
  EXPECT_NE(before(0, 30), after(0, 30));
}

TEST(EnergyCurve, SamplesFromImplausibleCorrelationsToo) {
  EnergyCurve curve = Curve();
  curve.correlation.setConstant(-1);  // of no process
  curve.correlation[0] = 1;
  EXPECT_TRUE(curve.IsValid());
  EXPECT_TRUE(curve.Sample(Levels::Ones(), Normal(1)).allFinite());
  for (const double wrong : {-1.5, 1.5, double{NAN}, double{INFINITY}}) {
    curve.correlation[1] = wrong;
    EXPECT_FALSE(curve.IsValid()) << wrong;
  }
}

}  // namespace choreo::energy_curve_test
