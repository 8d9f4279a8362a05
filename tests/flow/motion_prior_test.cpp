#include "model/flow/priors/motion_prior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_error.h"

namespace choreo::motion_prior_test {

// Velocities whose covariance falls off as a Gaussian, as smooth motion's does.
Eigen::MatrixXd SmoothCovariance() {
  Eigen::MatrixXd covariance(2, 60);
  for (int lag = 0; lag < covariance.cols(); ++lag) {
    covariance(0, lag) = 1e-4 * std::exp(-0.5 * std::pow(lag / 5.0, 2));
    covariance(1, lag) = 4e-4 * std::exp(-0.5 * std::pow(lag / 8.0, 2));
  }
  return covariance;
}

TEST(MotionPrior, MeanReachesItsKeyFromAnyHistory) {
  const MotionPrior prior(SmoothCovariance());
  const auto bridges = prior.Bridges(30, 30);
  for (const auto& bridge : *bridges) {
    EXPECT_NEAR(bridge.key[29], 1, 1e-3);
    EXPECT_NEAR(bridge.past.row(29).norm(), 0, 1e-2);
  }
}

TEST(MotionPrior, MeanStartsWithTheLastVelocity) {
  const MotionPrior prior(SmoothCovariance());
  for (const int to_key : {0, 60}) {
    const auto& bridge = prior.Bridges(60, to_key)->front();
    // A dancer at steady speed, without a key or with one on the way.
    const double first = bridge.past.row(0).sum() + 60.0 * bridge.key[0];
    EXPECT_NEAR(first, 1, 0.1) << to_key;
  }
}

TEST(MotionPrior, SpreadVanishesAtTheKeyAndIsGreatestHalfway) {
  const MotionPrior prior(SmoothCovariance());
  const auto keyed = prior.Bridges(40, 40), free = prior.Bridges(40, 0);
  const auto spread = [](const MotionPrior::Bridge& bridge, int frame) {
    return bridge.spread.row(frame).norm();
  };
  for (size_t d = 0; d < 2; ++d) {
    EXPECT_LT(spread((*keyed)[d], 39), 0.01 * spread((*keyed)[d], 20));
    EXPECT_GT(spread((*free)[d], 39), spread((*free)[d], 20));
    EXPECT_LT(spread((*keyed)[d], 20), spread((*free)[d], 20));
  }
}

TEST(MotionPrior, WindowBeforeAFarKeyStartsTheWholeTransition) {
  const MotionPrior prior(SmoothCovariance());
  const auto whole = prior.Bridges(50, 50), part = prior.Bridges(20, 50);
  for (size_t d = 0; d < 2; ++d) {
    EXPECT_LT(((*whole)[d].spread.topLeftCorner(20, 20) - (*part)[d].spread).norm(),
              1e-6 * (*part)[d].spread.norm());
    EXPECT_LT(((*whole)[d].key.head(20) - (*part)[d].key).norm(), 1e-6);
  }
}

TEST(MotionPrior, SamplesAreAsSmoothAsTheRecordings) {
  const MotionPrior prior(SmoothCovariance());
  const auto& bridge = prior.Bridges(60, 60)->front();
  // Variance of second differences in the middle: that of a velocity's step, 2 (r(0) - r(1)).
  const Eigen::RowVectorXf second =
      bridge.spread.row(31) - 2 * bridge.spread.row(30) + bridge.spread.row(29);
  const double expected = 2e-4 * (1 - std::exp(-0.5 / 25));
  EXPECT_NEAR(second.squaredNorm() / expected, 1, 0.25);
}

// Poses are stationary: how they return follows from their spread and that of ways.
TEST(MotionPrior, WithoutAKeyReturnsToTheUsualPose) {
  const Eigen::MatrixXd covariance = SmoothCovariance().replicate(3, 1);
  Eigen::VectorXd variance = Eigen::VectorXd::Constant(6, 1);
  const MotionPrior prior(covariance, {}, {.variance = variance}), wanderer(covariance);
  const auto home = prior.Bridges(90, 0), lost = wanderer.Bridges(90, 0);
  const auto stage = prior.StageBridges(90);
  EXPECT_EQ((*prior.Bridges(90, 90))[3].spread, (*wanderer.Bridges(90, 90))[3].spread);
  for (const size_t d : {0, 2, 4}) {  // the place but on a stage, where one faces
    EXPECT_EQ((*home)[d].key.norm(), 0);
    EXPECT_EQ((*home)[d].spread, (*lost)[d].spread);
  }
  for (const MotionPrior::Bridge& bridge : {(*home)[3], (*stage)[0], (*stage)[2]}) {
    for (int i = 1; i < 90; ++i) {
      EXPECT_GT(bridge.key[i], bridge.key[i - 1]);
      EXPECT_LT(bridge.key[i], 1);
    }
  }
  for (int i = 0; i < 90; ++i)
    EXPECT_LE((*home)[3].spread.row(i).norm(), (*lost)[3].spread.row(i).norm());
  // Apart from what the last velocities say: half the variance of the way over that of the pose.
  const double way = (*lost)[3].spread.row(89).squaredNorm();
  EXPECT_NEAR((*home)[3].key[89] / (0.5 * way), 1, 0.25);
}

TEST(MotionPrior, RefusesInvalidCovariances) {
  ExpectError(ErrorCode::kInvalidArgument, "velocity_covariance",
              [] { MotionPrior(Eigen::MatrixXd::Zero(2, 3)); });
}

// Keys may bend toes that no recording bends; a network must not see a storm.
TEST(MotionPrior, UnmovedDimensionsHaveTheMeanSpreadOfTheOthers) {
  Eigen::MatrixXd covariance = SmoothCovariance().replicate(9, 1);
  covariance.row(4) *= 4;
  covariance.row(8) *= 1e-8;
  const MotionPrior prior(covariance);
  EXPECT_FALSE(prior.Moves(8));
  const Eigen::VectorXd spread = prior.VelocitySpread();
  EXPECT_DOUBLE_EQ(spread[4], std::sqrt(covariance(4, 0)));
  const double others = spread.tail(15).sum() - spread[8];
  EXPECT_NEAR(spread[8], others / 14, 1e-12);
}

}  // namespace choreo::motion_prior_test
