#include "model/metrics/groove.h"

#include <gtest/gtest.h>

#include "tests/metrics/moving_body.h"
#include "tests/support/expect_error.h"

namespace choreo::groove_test {

using testing_support::Carried;
using testing_support::Wave;

const Skeleton& Body() { return Skeleton::Smpl24(); }

TEST(LimbTravel, OfStraightMotionEqualsItsChord) {
  const JointTrack track = Carried(121, [](double s) { return Eigen::Vector3d(s, 0, 0); });
  const LimbTravel travel = MeasureLimbTravel(Body(), track, {60, 120});
  EXPECT_NEAR(travel.chord, 4 * 4, 1e-9);  // four limbs, four seconds at 1 m/s
  EXPECT_NEAR(travel.path, travel.chord, 1e-9);
}

TEST(LimbTravel, CountsEveryDetourBetweenKeysAndNothingAfterTheLast) {
  // Half a circle a span: path over chord is half of pi.
  const JointTrack track = Carried(150, [](double s) {
    return Eigen::Vector3d(std::cos(M_PI * s / 2), 0, std::sin(M_PI * s / 2));
  });
  const LimbTravel travel = MeasureLimbTravel(Body(), track, {60, 120});
  EXPECT_NEAR(travel.chord, 4 * 2 * 2, 1e-9);
  EXPECT_NEAR(travel.path / travel.chord, M_PI / 2, 1e-3);
  EXPECT_EQ(MeasureLimbTravel(Body(), track, {}).path, 0);
}

TEST(LimbTravel, CountsAWavingHand) {
  std::vector<Pose> poses(61, RestPose(Body()));
  for (size_t t = 0; t < poses.size(); ++t)
    poses[t].rotations(2, Body().left_elbow) = Wave(1, static_cast<double>(t) / 30);
  const LimbTravel travel = MeasureLimbTravel(Body(), TrackJoints(Body(), poses), {60});
  EXPECT_NEAR(travel.chord, 0, 1e-9);
  EXPECT_GT(travel.path, 1);
}

TEST(LimbTravel, NeedsLimbs) {
  Skeleton pole;
  pole.name = "pole";
  pole.joint_names = {"pelvis"};
  pole.parents = {-1};
  pole.offsets = Eigen::Matrix3Xd::Zero(3, 1);
  ExpectError(ErrorCode::kInvalidArgument, "lacks knees",
              [&] { MeasureLimbTravel(pole, {Eigen::Matrix3Xd::Zero(3, 1)}, {}); });
}

TEST(PelvisBounce, IsTheRmsAboveOneHertz) {
  const auto bounce = [](double hz) {
    return PelvisBounce(
        Carried(600, [&](double s) { return Eigen::Vector3d(s, 0.03 * Wave(hz, s), 0); }), 30);
  };
  EXPECT_NEAR(bounce(3), 0.03 / std::sqrt(2), 0.001);
  EXPECT_LT(bounce(0.2), 0.001);  // who crouches and rises again bounces little
}

TEST(Jerk, IsTheMedianOfTheThirdDerivative) {
  const JointTrack cubic =
      Carried(200, [](double s) { return Eigen::Vector3d(0, 0, s * s * s / 6); });
  EXPECT_NEAR(RawJerk(cubic, 30), 1, 1e-4);
  EXPECT_NEAR(SmoothJerk(cubic, 30), 1, 0.02);
}

TEST(Jerk, FiltersOutRecordingNoise) {
  const auto dance = [](double noise) {
    return Carried(
        300, [=](double s) { return Eigen::Vector3d(0.3 * Wave(1, s), noise * Wave(14, s), 0); });
  };
  EXPECT_GT(RawJerk(dance(0.002), 30), 3 * RawJerk(dance(0), 30));
  EXPECT_NEAR(SmoothJerk(dance(0.002), 30) / SmoothJerk(dance(0), 30), 1, 0.1);
}

}  // namespace choreo::groove_test
