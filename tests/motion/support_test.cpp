#include "model/motion/floor/support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/core/numbers/random.h"
#include "model/motion/kinematics/body_mass.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo::support_test {

using Points = std::vector<Eigen::Vector2d>;

const Skeleton& Body() { return Skeleton::Smpl24(); }
Eigen::Matrix3Xd Rest() { return JointPositions(Body(), RestPose(Body())); }

// The rest pose's floor, as high as the lower toes.
constexpr double kRestFloor = 0.02;

std::vector<BodyPoints> PointsOf(const BalanceGauge& gauge, int frames,
                                 const std::function<Eigen::Matrix3Xd(double)>& joints) {
  std::vector<BodyPoints> points;
  for (int t = 0; t < frames; ++t) points.push_back(gauge.Of(joints(t / 30.0)));
  return points;
}

TEST(MassWeights, SumToOneWithAHumanCentreOfMass) {
  const Eigen::VectorXd weights = MassWeights(Body());
  ASSERT_EQ(weights.size(), Body().joints());
  EXPECT_NEAR(weights.sum(), 1, 1e-12);
  EXPECT_GE(weights.minCoeff(), 0);
  // Arms hang. Some 57 % of the stature, which is 1.73 m.
  Pose stands = RestPose(Body());
  stands.rotations(2, Body().left_shoulder) = -1.4;
  stands.rotations(2, Body().right_shoulder) = 1.4;
  const Eigen::Vector3d centre = JointPositions(Body(), stands) * weights;
  EXPECT_NEAR(centre.y(), 0.57 * 1.73, 0.015);
  EXPECT_NEAR(centre.x(), 0, 0.01);
  // A body that bends forwards has its centre in front.
  Pose bent = stands;
  bent.rotations(0, Body().Find("spine1")) = 1;
  EXPECT_GT((JointPositions(Body(), bent) * weights).z(), centre.z() + 0.1);
}

TEST(MassWeights, AreEmptyWithoutAllSegments) {
  for (const char* joint : {"head", "left_elbow", "right_knee"}) {
    Skeleton body = Body();
    body.joint_names[static_cast<size_t>(body.Find(joint))] = "other";
    body.AssignRoles();
    EXPECT_EQ(MassWeights(body).size(), 0) << joint;
    EXPECT_FALSE(BalanceGauge::Fits(body)) << joint;
  }
  EXPECT_TRUE(BalanceGauge::Fits(Body()));
}

TEST(DistanceToHull, IsZeroInsideAndToTheNearestPointOutside) {
  const Points square = {{0, 0}, {1, 1}, {1, 0}, {0.5, 0.5}, {0, 1}, {0, 0}};
  EXPECT_EQ(DistanceToHull({0.3, 0.6}, square), 0);
  EXPECT_EQ(DistanceToHull({1, 0.5}, square), 0);
  EXPECT_NEAR(DistanceToHull({1.5, 0.5}, square), 0.5, 1e-12);
  EXPECT_NEAR(DistanceToHull({-3, -4}, square), 5, 1e-12);
  EXPECT_NEAR(DistanceToHull({2, 0}, {{0, 0}, {1, 0}}), 1, 1e-12);
  EXPECT_NEAR(DistanceToHull({0.5, 2}, {{0, 0}, {1, 0}, {0.2, 0}}), 2, 1e-12);
  EXPECT_NEAR(DistanceToHull({0, 2}, {{0, 0}}), 2, 1e-12);
  EXPECT_EQ(DistanceToHull({0, 0}, {{0, 0}, {0, 0}, {0, 0}}), 0);
}

TEST(BalanceGauge, StandingBodyIsSupportedByBothFeet) {
  const BalanceGauge gauge(Body(), 30, kRestFloor);
  const auto points = PointsOf(gauge, 20, [](double) { return Rest(); });
  for (size_t t = 0; t < points.size(); ++t) {
    const Balance balance = gauge.At(points, t);
    EXPECT_NEAR(balance.acceleration.norm(), 0, 1e-9);
    EXPECT_EQ(balance.on_floor, (std::array{true, true, true, true}));
    EXPECT_EQ(*balance.centre_outside, 0);
    EXPECT_NEAR(*balance.zmp_outside, 0, 1e-9);
    EXPECT_TRUE(balance.Supported());
  }
}

TEST(BalanceGauge, ThrownBodyIsBallisticAndCarriedBodyIsNot) {
  const BalanceGauge gauge(Body(), 30, kRestFloor);
  const auto thrown = PointsOf(gauge, 40, [](double s) -> Eigen::Matrix3Xd {
    return Rest().colwise() + Eigen::Vector3d(s, 3 + 4 * s - 0.5 * kGravity * s * s, 0);
  });
  const auto carried = PointsOf(gauge, 40, [](double s) -> Eigen::Matrix3Xd {
    return Rest().colwise() + Eigen::Vector3d(s, 1 + s, 0);
  });
  for (size_t t = 8; t < 32; ++t) {
    const Balance flight = gauge.At(thrown, t);
    EXPECT_NEAR(flight.acceleration.y(), -kGravity, 1e-6);
    EXPECT_TRUE(flight.Thrown());
    EXPECT_TRUE(flight.Supported());
    EXPECT_FALSE(flight.centre_outside);
    const Balance hover = gauge.At(carried, t);
    EXPECT_NEAR(hover.acceleration.y(), 0, 1e-6);
    EXPECT_FALSE(hover.Supported());
    EXPECT_NEAR(hover.foot_height, 1 + static_cast<double>(t) / 30, 1e-3);
  }
}

TEST(BalanceGauge, TiltedBodyIsOutsideByTheSineOfTheAngle) {
  const BalanceGauge gauge(Body(), 30, kRestFloor);
  const Eigen::VectorXd weights = MassWeights(Body());
  const Eigen::Matrix3Xd rest = Rest();
  // About a line through the toes that are further in front; ankles rise.
  const Eigen::Vector3d left = rest.col(Body().feet[1]), right = rest.col(Body().feet[3]);
  const Eigen::Vector3d pivot(0, kRestFloor, std::max(left.z(), right.z()));
  for (const double degrees : {30.0, 50.0}) {
    const Eigen::Matrix3d turn = ExpMap({degrees / kDegrees, 0, 0});
    const Eigen::Matrix3Xd tilted = (turn * (rest.colwise() - pivot)).colwise() + pivot;
    const auto points = PointsOf(gauge, 15, [&](double) { return tilted; });
    const Balance balance = gauge.At(points, 7);
    const Eigen::Vector3d above = rest * weights - pivot;
    const double front =
        std::sin(degrees / kDegrees) * above.y() + std::cos(degrees / kDegrees) * above.z();
    EXPECT_NEAR(*balance.centre_outside, front, 0.01) << degrees;
    EXPECT_NEAR(*balance.zmp_outside, *balance.centre_outside, 1e-9);
    EXPECT_FALSE(balance.Supported());
  }
}

TEST(BalanceGauge, AccelerationMovesTheZmpBackwards) {
  const BalanceGauge gauge(Body(), 30, kRestFloor);
  const double push = 4;
  const auto points = PointsOf(gauge, 40, [&](double s) -> Eigen::Matrix3Xd {
    return Rest().colwise() + Eigen::Vector3d(0, 0, 0.5 * push * s * s);
  });
  const Balance balance = gauge.At(points, 20);
  EXPECT_NEAR(balance.acceleration.z(), push, 1e-6);
  // The smoothed centre is slightly ahead, as the mean of squares exceeds the mean's square.
  const double zmp = balance.centre.z() - (balance.centre.y() - kRestFloor) * push / kGravity;
  const double heels = points[20].feet.row(2).minCoeff();
  EXPECT_NEAR(*balance.zmp_outside, heels - zmp, 0.005);
  EXPECT_FALSE(balance.Supported());
}

TEST(SupportMeter, StreamingEqualsTheWhole) {
  Random random(3);
  for (const int frames : {1, 2, 5, 8, 15, 16, 90}) {
    std::vector<Eigen::Matrix3Xd> track;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (int t = 0; t < frames; ++t) {
      at += 0.03 * Eigen::Vector3d(random.Normal(), 0.5 * random.Normal(), random.Normal());
      track.push_back(Rest().colwise() + at);
    }
    const BalanceGauge gauge(Body(), 30, Rest().row(1).minCoeff());
    std::vector<BodyPoints> points;
    for (const Eigen::Matrix3Xd& joints : track) points.push_back(gauge.Of(joints));
    SupportMeter meter(Body(), 30);
    double supported = 0;
    for (size_t t = 0; t < track.size(); ++t) {
      meter.Add(track[t]);
      supported += gauge.At(points, t).Supported();
    }
    EXPECT_DOUBLE_EQ(meter.Share(), supported / frames) << frames;
    EXPECT_DOUBLE_EQ(meter.Share(), supported / frames) << "asked again";
    if (frames == 90) {
      EXPECT_GT(supported, 0);
      EXPECT_LT(supported, frames);
    }
  }
}

TEST(SupportMeter, IsOneWithoutFrames) { EXPECT_EQ(SupportMeter(Body(), 30).Share(), 1); }

}  // namespace choreo::support_test
