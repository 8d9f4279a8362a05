#include "model/motion/rotation.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "model/core/error.h"
#include "model/motion/motion.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo::rotation_test {

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance = 1e-9;

Eigen::Vector3d RandomAxis(std::mt19937& generator) {
  return fixtures::RandomVector(generator, 1.0).normalized();
}

// Angles where implementations break: zero, denormal-small, around the switch of formulas, near and
// at pi.
const double kAngles[] = {0,    1e-300, 1e-12,  1e-9, 1e-8,       1.1e-8,     1e-6,
                          1e-3, 0.5,    1.5707, 3.0,  kPi - 1e-4, kPi - 1e-8, kPi - 1e-12};

TEST(Rotation, ExpMapIsARotationThatKeepsItsAxisAndTurnsByItsAngle) {
  std::mt19937 generator(1);
  for (const double angle : kAngles) {
    const Eigen::Vector3d axis = RandomAxis(generator);
    const Eigen::Matrix3d r = ExpMap(axis * angle);
    EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).norm(), 1e-12) << angle;
    EXPECT_NEAR(r.determinant(), 1, 1e-12) << angle;
    EXPECT_LT((r * axis - axis).norm(), 1e-12) << angle;
    const Eigen::Vector3d side = axis.unitOrthogonal();
    EXPECT_NEAR((r * side).dot(side), std::cos(angle), 1e-12) << angle;
    EXPECT_NEAR((r * side).dot(axis.cross(side)), std::sin(angle), 1e-12) << angle;
  }
}

TEST(Rotation, ExpMapOfKnownTurns) {
  Eigen::Matrix3d quarter;
  quarter << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  EXPECT_LT((ExpMap({0, kPi / 2, 0}) - quarter).norm(), 1e-12);
  EXPECT_LT((ExpMap({2 * kPi, 0, 0}) - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(Rotation, LogMapInvertsExpMapFromZeroToPi) {
  std::mt19937 generator(2);
  for (const double angle : kAngles) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      const Eigen::Vector3d w = RandomAxis(generator) * angle;
      EXPECT_LT((LogMap(ExpMap(w)) - w).norm(), 1e-6 * std::max(angle, 1e-9)) << angle;
    }
  }
}

TEST(Rotation, LogMapAtExactlyPiGivesOneOfTheTwoAxes) {
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1),
        Eigen::Vector3d(1, 1, 1).normalized(), Eigen::Vector3d(-1, 2, 0.01).normalized()}) {
    const Eigen::Matrix3d half_turn = 2 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
    const Eigen::Vector3d w = LogMap(half_turn);
    EXPECT_NEAR(w.norm(), kPi, kTolerance);
    EXPECT_LT((ExpMap(w) - half_turn).norm(), kTolerance);
  }
}

TEST(Rotation, QuaternionsAgreeWithMatrices) {
  std::mt19937 generator(3);
  for (const double angle : kAngles) {
    const Eigen::Vector3d w = RandomAxis(generator) * angle;
    const Eigen::Quaterniond q = QuaternionFromExp(w);
    EXPECT_NEAR(q.norm(), 1, 1e-12);
    EXPECT_LT((q.toRotationMatrix() - ExpMap(w)).norm(), 1e-12) << angle;
    EXPECT_LT((ExpFromQuaternion(q) - w).norm(), 1e-9) << angle;
    EXPECT_LT((ExpFromQuaternion(Eigen::Quaterniond(-q.coeffs())) - w).norm(), 1e-9) << angle;
  }
}

TEST(Rotation, NearestBranchIsTheNearestOfAllVectorsOfTheSameRotation) {
  std::mt19937 generator(4);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const Eigen::Vector3d w = fixtures::RandomVector(generator, 3.0);
    const Eigen::Vector3d previous = fixtures::RandomVector(generator, 12.0);
    const Eigen::Vector3d nearest = NearestBranch(w, previous);
    EXPECT_LT((ExpMap(nearest) - ExpMap(w)).norm(), 1e-9);
    for (int turns = -4; turns <= 4; ++turns) {
      const Eigen::Vector3d other = w.normalized() * (w.norm() + 2 * kPi * turns);
      EXPECT_LE((nearest - previous).norm(), (other - previous).norm() + 1e-9);
    }
  }
  // The identity has every axis: it stands for whole turns about the previous one.
  EXPECT_LT(
      (NearestBranch(Eigen::Vector3d::Zero(), {0, 6.2, 0}) - Eigen::Vector3d(0, 2 * kPi, 0)).norm(),
      1e-12);
  EXPECT_EQ(NearestBranch(Eigen::Vector3d::Zero(), {0, 1, 0}), Eigen::Vector3d::Zero());
}

TEST(Rotation, AContinuousTurnThroughPiStaysContinuous) {
  Motion motion;
  for (int frame = 0; frame < 400; ++frame) {
    Pose pose;
    // Principal values jump from pi to -pi about the axis; the axis tilts a little meanwhile.
    const Eigen::Vector3d axis =
        Eigen::Vector3d(0.1 * std::sin(0.05 * frame), 1, 0.05).normalized();
    pose.rotations = LogMap(ExpMap(axis * (0.3 + 0.05 * frame)));
    motion.frames.push_back(pose);
  }
  const Motion principal = motion;
  MakeContinuous(motion);
  double largest = 0;
  double largest_before = 0;
  for (size_t frame = 1; frame < motion.frames.size(); ++frame) {
    const auto step = [frame](const Motion& m) {
      return (m.frames[frame].rotations - m.frames[frame - 1].rotations).norm();
    };
    largest = std::max(largest, step(motion));
    largest_before = std::max(largest_before, step(principal));
    EXPECT_LT(
        (ExpMap(motion.frames[frame].rotations) - ExpMap(principal.frames[frame].rotations)).norm(),
        1e-9);
  }
  EXPECT_GT(largest_before, 5);
  EXPECT_LT(largest, 0.2);
  EXPECT_GT(motion.frames.back().rotations.norm(), 15);
}

TEST(Rotation, SlerpMeetsItsEndsAndMovesEvenly) {
  std::mt19937 generator(5);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Eigen::Vector3d a = fixtures::RandomVector(generator, 1.7);
    const Eigen::Vector3d b = fixtures::RandomVector(generator, 1.7);
    EXPECT_LT((Slerp(a, b, 0) - a).norm(), kTolerance);
    EXPECT_LT((ExpMap(Slerp(a, b, 1)) - ExpMap(b)).norm(), kTolerance);
    const double whole = RotationDifference(a, b).norm();
    for (const double t : {0.25, 0.5, 0.9}) {
      const Eigen::Vector3d between = Slerp(a, b, t);
      EXPECT_NEAR(RotationDifference(a, between).norm(), t * whole, kTolerance);
      EXPECT_NEAR(RotationDifference(between, b).norm(), (1 - t) * whole, kTolerance);
    }
  }
}

TEST(Rotation, DifferenceAndCompositionAreInverse) {
  std::mt19937 generator(6);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Eigen::Vector3d a = fixtures::RandomVector(generator, 1.7);
    const Eigen::Vector3d b = fixtures::RandomVector(generator, 1.7);
    const Eigen::Vector3d difference = RotationDifference(a, b);
    EXPECT_LT((ExpMap(difference) - ExpMap(a).transpose() * ExpMap(b)).norm(), kTolerance);
    EXPECT_LT((ExpMap(RotationCompose(a, difference)) - ExpMap(b)).norm(), kTolerance);
  }
}

TEST(Rotation, SixDRoundTripsAndRepairsScaleAndSkew) {
  std::mt19937 generator(7);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Eigen::Matrix3d r = ExpMap(fixtures::RandomVector(generator, 1.8));
    Eigen::Matrix<double, 6, 1> d = SixDFromMatrix(r);
    EXPECT_LT((MatrixFromSixD(d) - r).norm(), 1e-12);
    d.head<3>() *= 3.0;
    d.tail<3>() = 0.2 * d.tail<3>() + 0.7 * d.head<3>();
    EXPECT_LT((MatrixFromSixD(d) - r).norm(), 1e-12);
  }
}

TEST(Rotation, SixDRefusesParallelVectors) {
  Eigen::Matrix<double, 6, 1> parallel;
  parallel << 1, 2, 3, -2, -4, -6;
  EXPECT_THROW(MatrixFromSixD(parallel), Error);
  EXPECT_THROW(MatrixFromSixD(Eigen::Matrix<double, 6, 1>::Zero()), Error);
  EXPECT_THROW(MatrixFromSixD(Eigen::Matrix<double, 6, 1>::Constant(std::nan(""))), Error);
}

TEST(Rotation, HeadingReadsTheTurnAboutY) {
  for (double heading = -3.1; heading < 3.14; heading += 0.1) {
    EXPECT_NEAR(Heading(HeadingRotation(heading)), heading, 1e-12);
    EXPECT_NEAR(Heading(HeadingRotation(heading) * ExpMap({0.4, 0, 0})), heading, 1e-12);
    EXPECT_LT((HeadingRotation(heading) - ExpMap({0, heading, 0})).norm(), 1e-12);
  }
  EXPECT_NEAR(Heading(HeadingRotation(kPi / 2)), kPi / 2, 1e-12);
  EXPECT_GT(HeadingRotation(kPi / 2).col(2).x(), 0.99);
  EXPECT_NEAR(std::abs(Heading(HeadingRotation(kPi))), kPi, 1e-12);
}

TEST(Rotation, WrapAngleStaysInItsRange) {
  EXPECT_DOUBLE_EQ(WrapAngle(kPi), kPi);
  EXPECT_DOUBLE_EQ(WrapAngle(-kPi), kPi);
  EXPECT_NEAR(WrapAngle(7 * kPi + 0.5), -kPi + 0.5, 1e-12);
  EXPECT_NEAR(WrapAngle(-0.25 - 4 * kPi), -0.25, 1e-12);
}

TEST(Rotation, RightJacobianIsHowTheExponentialMapTurns) {
  for (const double angle : {0.0, 1e-4, 0.009, 0.011, 0.7, 2.9, 5.0}) {
    const Eigen::Vector3d w = angle * Eigen::Vector3d(0.6, -0.48, 0.64);
    const Eigen::Matrix3d jacobian = RightJacobian(w);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = 1e-5 * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d seen = LogMap(ExpMap(w - step).transpose() * ExpMap(w + step)) / 2e-5;
      EXPECT_LT((jacobian.col(axis) - seen).norm(), 1e-7) << angle;
    }
  }
}

}  // namespace choreo::rotation_test
