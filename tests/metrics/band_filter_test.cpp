#include "model/metrics/band_filter.h"

#include <gtest/gtest.h>

#include "tests/metrics/moving_body.h"

namespace choreo::band_filter_test {

using testing_support::Wave;

Eigen::VectorXd Sampled(double hz) {
  Eigen::VectorXd values(300);
  for (Eigen::Index t = 0; t < 300; ++t) values[t] = Wave(hz, static_cast<double>(t) / 30);
  return values;
}

// Of the middle, where no end matters.
double Rms(const Eigen::VectorXd& values) {
  return std::sqrt(values.segment(90, 120).squaredNorm() / 120);
}

TEST(BandFilter, KeepsLowHalvesCutoffAndDropsHighFrequencies) {
  const auto gain = [](double hz) { return Rms(LowPass(Sampled(hz), 30, 3)) / Rms(Sampled(hz)); };
  EXPECT_NEAR(gain(0.5), 1, 0.01);
  EXPECT_NEAR(gain(3), 0.5, 0.01);
  EXPECT_LT(gain(9), 0.01);
}

TEST(BandFilter, DelaysNothing) {
  const Eigen::VectorXd slow = Sampled(0.5);
  EXPECT_LT((LowPass(slow, 30, 3) - slow).segment(90, 120).cwiseAbs().maxCoeff(), 0.01);
}

TEST(BandFilter, LeavesALineAloneEvenAtItsEnds) {
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(120, -3, 5);
  EXPECT_LT((line - LowPass(line, 30, 1)).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_EQ(LowPass(line.head(3), 30, 1), line.head(3));
}

TEST(BandFilter, FiltersEachCoordinateOfATrack) {
  const JointTrack track = testing_support::Carried(
      300, [](double s) { return Eigen::Vector3d(Wave(0.5, s), Wave(9, s), 0); });
  const JointTrack smooth = LowPass(track, 30, 3);
  for (size_t t = 90; t < 210; ++t) {
    EXPECT_NEAR(smooth[t](0, 5), track[t](0, 5), 0.01);
    EXPECT_NEAR(smooth[t](1, 5), track[0](1, 5), 0.01);
  }
}

}  // namespace choreo::band_filter_test
