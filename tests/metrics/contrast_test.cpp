#include "model/metrics/contrast.h"

#include <gtest/gtest.h>

#include <numbers>

#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/metrics/moving_body.h"
#include "tests/support/expect_error.h"

namespace choreo::contrast_test {

using testing_support::Carried;

const Skeleton& Body() { return Skeleton::Smpl24(); }

// Turns about the vertical, degrees a second, for that many seconds.
std::vector<Pose> Spinning(double rate, int seconds) {
  std::vector<Pose> poses;
  for (int t = 0; t <= 30 * seconds; ++t) {
    poses.push_back(RestPose(Body()));
    poses.back().rotations(1, 0) = WrapAngle(rate / kDegrees * t / 30);
  }
  return poses;
}

TEST(WindowTurns, CountWholeTurnsAndWhichWayTheyGo) {
  for (const double rate : {0.0, 60.0, -200.0, 400.0}) {
    const std::vector<double> turns = WindowTurns(Spinning(rate, 6), 30);
    ASSERT_EQ(turns.size(), 3U);
    for (const double turn : turns) EXPECT_NEAR(turn * kDegrees, 2 * rate, 1e-6);
  }
  EXPECT_EQ(WindowTurns(Spinning(60, 5), 30).size(), 2U);  // the remainder is not a window
  EXPECT_TRUE(WindowTurns({}, 30).empty());
}

TEST(FacesAway, CountsPosesBeyondARightAngle) {
  const std::vector<Pose> once = Spinning(60, 6);  // a whole turn
  EXPECT_NEAR(FacesAway(once, 0), 0.5, 0.02);
  EXPECT_NEAR(FacesAway(once, 2), 0.5, 0.02);
  const std::vector<Pose> still = Spinning(0, 1);
  EXPECT_EQ(FacesAway(still, 1.5), 0);
  EXPECT_EQ(FacesAway(still, 1.6), 1);
  EXPECT_EQ(FacesAway(still, 2 * std::numbers::pi), 0);
  EXPECT_EQ(FacesAway({}, 0), 0);
}

TEST(MeanFacing, IsADirection) {
  const std::vector<Pose> quarter = Spinning(30, 3);
  EXPECT_NEAR(MeanFacing(quarter) * kDegrees, 45, 1e-6);
  std::vector<Pose> behind;
  for (const double heading : {3.0, -3.0}) {
    Pose pose = quarter.front();
    pose.rotations.col(0) = Eigen::Vector3d(0, heading, 0);
    behind.push_back(pose);
  }
  EXPECT_NEAR(std::abs(MeanFacing(behind)), std::numbers::pi, 1e-9);
}

TEST(TrunkLean, IsTheTrunksAngleToTheVertical) {
  JointTrack track;
  for (const double lean : {0.0, 30.0, 120.0}) {
    Pose pose = RestPose(Body());
    pose.rotations.col(0) = Eigen::Vector3d(0.6, 0, 0.8) * lean / kDegrees;
    track.push_back(JointPositions(Body(), pose));
  }
  const std::vector<double> lean = TrunkLean(Body(), track);
  ASSERT_EQ(lean.size(), 3U);
  const double rest = lean[0];  // shoulders are slightly behind the pelvis
  EXPECT_LT(rest, 10);
  EXPECT_NEAR(lean[1], 30, rest);
  EXPECT_NEAR(lean[2], 120, rest);
}

TEST(HandsAtRest, AreSlowHands) {
  const auto share = [](double speed) {
    JointTrack track = Carried(61, [](double s) { return Eigen::Vector3d(s, 0, 0); });
    for (size_t t = 0; t < track.size(); ++t) {
      for (const char* wrist : {"left_wrist", "right_wrist"})
        track[t](1, Body().Find(wrist)) += speed * static_cast<double>(t) / 30;
    }
    return HandsAtRest(Body(), 30, track);
  };
  EXPECT_EQ(share(0), 1);  // though the body walks
  EXPECT_EQ(share(0.9 * kRestSpeed), 1);
  EXPECT_EQ(share(1.1 * kRestSpeed), 0);
  // One of the two for half of the time.
  JointTrack track = Carried(61, [](double) { return Eigen::Vector3d::Zero().eval(); });
  for (int t = 31; t <= 60; ++t)
    track[static_cast<size_t>(t)](0, Body().Find("left_wrist")) += 0.1 * (t - 30);
  EXPECT_DOUBLE_EQ(HandsAtRest(Body(), 30, track), 0.75);
  Skeleton body = Body();
  body.left_elbow = -1;
  ExpectError(ErrorCode::kInvalidArgument, "lacks elbows", [&] { HandsAtRest(body, 30, track); });
}

TEST(PaceSpread, IsTheSpreadOfLogSpeed) {
  // Two seconds at 1 m/s, two at e m/s, and so on.
  double x = 0;
  JointTrack track;
  for (int t = 0; t <= 240; ++t) {
    track.push_back(Carried(1, [&](double) { return Eigen::Vector3d(x, 0, 0); })[0]);
    x += (t / 60 % 2 == 0 ? 1 : std::exp(1)) / 30;
  }
  EXPECT_NEAR(PaceSpread(30, track), std::sqrt(4 * 0.25 / 3), 1e-5);
  EXPECT_NEAR(PaceSpread(30, Carried(300, [](double s) { return Eigen::Vector3d(s, 0, 0); })), 0,
              1e-5);
  EXPECT_TRUE(
      std::isnan(PaceSpread(30, Carried(100, [](double s) { return Eigen::Vector3d(s, 0, 0); }))));
}

}  // namespace choreo::contrast_test
