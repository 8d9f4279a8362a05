#include "model/metrics/speed_spectrum.h"

#include <gtest/gtest.h>

#include "tests/metrics/moving_body.h"
#include "tests/support/expect_error.h"

namespace choreo::speed_spectrum_test {

using testing_support::Carried;
using testing_support::Wave;

TEST(SpeedSpectrum, PutsAWaveIntoItsBandWithItsPower) {
  for (const auto& [hz, band] :
       std::vector<std::pair<double, int>>{{1, 0}, {2, 1}, {4, 2}, {8, 3}}) {
    const JointTrack track =
        Carried(301, [&](double s) { return Eigen::Vector3d(0, Wave(hz, s), 0); });
    const Eigen::MatrixXd power = SpeedSpectrum(track, 30);
    // The difference of neighbours is a little less than the derivative.
    const double speed = 2 * 30 * std::sin(M_PI * hz / 30);
    EXPECT_NEAR(power(band, 1), speed * speed / 2, 0.02 * speed * speed) << hz;
    EXPECT_NEAR(power.col(1).sum(), power(band, 1), 0.02 * power(band, 1)) << hz;
    EXPECT_NEAR(power.col(0).sum(), 0, 1e-12);
    // Relative to the pelvis nothing moves.
    EXPECT_NEAR(power.rightCols(power.cols() - 2).sum(), 0, 1e-12);
  }
}

TEST(SpeedSpectrum, DoesNotDependOnTheDirectionOnTheFloor) {
  const auto along = [](double x, double z) {
    return SpeedSpectrum(
        Carried(31, [=](double s) { return Eigen::Vector3d(x * Wave(2, s), 0, z * Wave(2, s)); }),
        30);
  };
  EXPECT_TRUE(along(1, 0).isApprox(along(0.6, 0.8)));
}

TEST(SpeedSpectrum, NeedsNineFrames) {
  ExpectError(ErrorCode::kInvalidArgument, "8 frames", [] {
    SpeedSpectrum(Carried(8, [](double) { return Eigen::Vector3d(0, 0, 0); }), 30);
  });
}

}  // namespace choreo::speed_spectrum_test
