#include "model/metrics/balance.h"

#include <gtest/gtest.h>

#include "model/motion/rotation.h"
#include "tests/metrics/moving_body.h"
#include "tests/support/expect_error.h"

namespace choreo::balance_test {

using testing_support::Carried;

const Skeleton& Body() { return Skeleton::Smpl24(); }

constexpr double kRestFloor = 0.02;  // toes at rest

WeightFigures Measure(const JointTrack& track) {
  return MeasureWeight(Body(), 30, track, kRestFloor);
}

TEST(DancedFloor, IsTheHeightOfStandingFeet) {
  const JointTrack track = Carried(100, [](double s) {
    return Eigen::Vector3d(s, s < 2 ? -0.94 : 0, 0);  // two thirds on a floor that is off
  });
  EXPECT_NEAR(DancedFloor(Body(), track), kRestFloor - 0.94, 0.005);
}

TEST(Weight, StandingBodyIsSupported) {
  const WeightFigures still =
      Measure(Carried(60, [](double) { return Eigen::Vector3d::Zero().eval(); }));
  EXPECT_EQ(still.hover_share, 0);
  EXPECT_TRUE(std::isnan(still.hover_acceleration));
  EXPECT_EQ(still.longest_hover_s, 0);
  EXPECT_EQ(still.zmp_outside, 0);
  EXPECT_EQ(still.centre_outside, 0);
  EXPECT_EQ(still.supported, 1);
  EXPECT_EQ(still.contact_frames, 60);
}

TEST(Weight, LiftedBodyHasNoSupport) {
  const WeightFigures lifted =
      Measure(Carried(60, [](double s) { return Eigen::Vector3d(0.3 * s, 0.2, 0); }));
  EXPECT_EQ(lifted.hover_share, 1);
  EXPECT_NEAR(lifted.hover_acceleration, 0, 1e-9);
  EXPECT_NEAR(lifted.longest_hover_s, 2, 1e-9);
  EXPECT_EQ(lifted.supported, 0);
  EXPECT_EQ(lifted.contact_frames, 0);
}

TEST(Weight, JumpingBodyDoesNotHover) {
  // Half a second in the air, once a second.
  const JointTrack track = Carried(120, [](double s) {
    const double t = std::fmod(s, 1);
    return Eigen::Vector3d(0, t < 0.5 ? 0.5 * kGravity * t * (0.5 - t) : 0, 0);
  });
  const WeightFigures jumps = Measure(track);
  EXPECT_GT(jumps.hover_share, 0.3);
  EXPECT_LT(jumps.hover_share, 0.5);
  EXPECT_NEAR(jumps.hover_acceleration, -kGravity, 1);  // smoothed at both ends
  EXPECT_EQ(jumps.longest_hover_s, 0);
  // The same way in the same time, but at constant speed.
  const WeightFigures carried = Measure(Carried(
      120, [](double s) { return Eigen::Vector3d(0, 0.6 * std::abs(0.5 - std::fmod(s, 1)), 0); }));
  EXPECT_NEAR(carried.longest_hover_s, 0.53, 0.07);
}

TEST(Weight, LeaningBodyIsOutsideItsFeet) {
  JointTrack track = Carried(60, [](double) { return Eigen::Vector3d::Zero().eval(); });
  const Eigen::Matrix3d tilt = ExpMap({0.25, 0, 0});
  for (size_t t = 30; t < 60; ++t) {
    // All but the feet, whose joints stay.
    Eigen::Matrix3Xd tilted = tilt * track[t];
    for (const int foot : Body().feet) tilted.col(foot) = track[t].col(foot);
    track[t] = tilted;
  }
  const WeightFigures leaning = Measure(track);
  EXPECT_NEAR(leaning.centre_outside, 0.5, 0.04);
  EXPECT_EQ(leaning.hover_share, 0);
}

TEST(Weight, ContactLastsAsLongAsTheFootRests) {
  JointTrack track = Carried(120, [](double) { return Eigen::Vector3d::Zero().eval(); });
  // Each foot alternately 20 frames down, 10 up.
  for (int t = 0; t < 120; ++t) {
    for (const int side : {0, 2}) {
      if ((t + 15 * side / 2) % 30 < 20) continue;
      track[static_cast<size_t>(t)](1, Body().feet[side]) += 0.2;
      track[static_cast<size_t>(t)](1, Body().feet[side + 1]) += 0.2;
    }
  }
  EXPECT_EQ(Measure(track).contact_frames, 20);
  EXPECT_EQ(Measure(track).hover_share, 0);
}

TEST(Weight, NeedsKnownMassesAndFrames) {
  Skeleton body = Body();
  body.joint_names[static_cast<size_t>(body.Find("head"))] = "skull";
  ExpectError(ErrorCode::kInvalidArgument, "'smpl24' of 24 joints", [&] {
    MeasureWeight(body, 30, Carried(2, [](double) { return Eigen::Vector3d::Zero().eval(); }), 0);
  });
  ExpectError(ErrorCode::kInvalidArgument, "0 frames", [&] { MeasureWeight(Body(), 30, {}, 0); });
}

}  // namespace choreo::balance_test
