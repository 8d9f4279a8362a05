#include <gtest/gtest.h>

#include <numbers>

#include "model/core/error.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/velocity.h"
#include "model/motion/resample.h"
#include "model/motion/rotation.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo::locomotion_test {

constexpr double kPi = std::numbers::pi;

TEST(Velocity, WalkingACircleInClosedForm) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const double fps = 1000;
  const double radius = 2;
  const double rate = 0.7;  // rad/s, turning left
  const auto at = [&](double time) {
    Pose pose = RestPose(smpl);
    // Facing along the tangent: heading h moves along (sin h, cos h).
    const double heading = rate * time;
    pose.root_position +=
        Eigen::Vector3d(-radius * std::cos(heading), 0, radius * std::sin(heading));
    pose.rotations.col(0) = Eigen::Vector3d(0, heading, 0);
    return pose;
  };
  for (int frame = 0; frame < 12000; frame += 613) {
    const RootVelocity v = RootVelocityBetween(at(frame / fps), at((frame + 1) / fps), fps);
    // The chord of a step of rate / fps radians.
    const double half = 0.5 * rate / fps;
    const double chord = 2 * radius * std::sin(half) * fps;
    EXPECT_NEAR(v.forward, chord * std::cos(half), 1e-6);
    EXPECT_NEAR(v.sideways, chord * std::sin(half), 1e-6);
    EXPECT_NEAR(v.yaw, rate, 1e-6);
  }
}

TEST(Velocity, SidewaysIsPositiveToTheLeft) {
  const Skeleton& smpl = Skeleton::Smpl24();
  Pose earlier = RestPose(smpl);
  earlier.rotations.col(0) = Eigen::Vector3d(0, kPi / 2, 0);  // faces +X, left is -Z
  Pose later = earlier;
  later.root_position += Eigen::Vector3d(0.1, 0.5, -0.2);
  const RootVelocity v = RootVelocityBetween(earlier, later, 30);
  EXPECT_NEAR(v.forward, 3, 1e-9);
  EXPECT_NEAR(v.sideways, 6, 1e-9);
  EXPECT_NEAR(v.yaw, 0, 1e-9);
}

TEST(Velocity, DoesNotDependOnTheSceneAndTurnsTheShortWay) {
  const Skeleton& smpl = Skeleton::Smpl24();
  Pose earlier = RestPose(smpl);
  earlier.rotations.col(0) = Eigen::Vector3d(0, kPi - 0.1, 0);
  Pose later = earlier;
  later.rotations.col(0) = Eigen::Vector3d(0, -kPi + 0.1, 0);
  EXPECT_NEAR(RootVelocityBetween(earlier, later, 30).yaw, 6, 1e-9);
  const GroundFrame moved{.origin = {5, 0, -3}, .heading = 1.234};
  const RootVelocity v = RootVelocityBetween(moved.ToWorld(earlier), moved.ToWorld(later), 30);
  EXPECT_NEAR(v.yaw, 6, 1e-9);
}

// Feet that alternately stand for half a period and swing forward for the other half; toes and
// ankle move together.
struct Gait {
  static constexpr int kPeriod = 30;
  static constexpr double kFps = 30;
  Skeleton skeleton = Skeleton::Smpl24();
  Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));

  static bool Stands(bool left, int frame) { return (frame / (kPeriod / 2)) % 2 == (left ? 0 : 1); }
  Eigen::Matrix3Xd At(int frame) const {
    Eigen::Matrix3Xd positions = rest;
    for (const bool left : {true, false}) {
      const int shifted = left ? frame : frame + kPeriod / 2;
      const int cycle = shifted / kPeriod;
      const double phase = static_cast<double>(shifted % kPeriod) / (kPeriod / 2);
      const double swing = std::max(0.0, phase - 1);
      for (int part = 0; part < 2; ++part) {
        const int joint = skeleton.feet[(left ? 0 : 2) + part];
        positions(2, joint) += 1.2 * (cycle + (0.5 - 0.5 * std::cos(kPi * swing)));
        positions(1, joint) += 0.15 * std::sin(kPi * swing);
      }
    }
    return positions;
  }
};

TEST(Contacts, FollowASyntheticGait) {
  const Gait gait;
  ContactDetector detector(gait.skeleton);
  int wrong = 0;
  int down = 0;
  const int frames = 10 * Gait::kPeriod;
  for (int frame = 1; frame < frames; ++frame) {
    const Contacts& contacts = detector.Next(gait.At(frame - 1), gait.At(frame), Gait::kFps);
    for (int foot = 0; foot < 4; ++foot) {
      wrong += (contacts[foot] > 0.5F) != Gait::Stands(foot < 2, frame);
      down += contacts[foot] > 0.5F;
    }
  }
  EXPECT_NEAR(down, 2 * frames, 0.15 * 2 * frames);
  // At most the first and last two frames of a swing are still slow and low.
  EXPECT_LT(wrong, 4 * 10 * 4);
}

TEST(Contacts, HysteresisHoldsBetweenTheThresholds) {
  const Gait gait;
  ContactDetector detector(gait.skeleton);
  const auto lifted = [&](double height) {
    Eigen::Matrix3Xd positions = gait.rest;
    positions.row(1).array() += height;
    return positions;
  };
  EXPECT_EQ(detector.Next(lifted(0.05), lifted(0.05), 30), (Contacts{0, 0, 0, 0}));
  EXPECT_EQ(detector.Next(lifted(0.03), lifted(0.03), 30), (Contacts{1, 1, 1, 1}));
  EXPECT_EQ(detector.Next(lifted(0.05), lifted(0.05), 30), (Contacts{1, 1, 1, 1}));
  EXPECT_EQ(detector.Next(lifted(0.08), lifted(0.08), 30), (Contacts{0, 0, 0, 0}));
  // Low but fast: 2 cm a frame is 0.6 m/s.
  EXPECT_EQ(detector.Next(lifted(0.0), lifted(0.02), 30), (Contacts{0, 0, 0, 0}));
}

TEST(Contacts, StandingStillIsAllContactFromTheFirstFrame) {
  const Skeleton& smpl = Skeleton::Smpl24();
  Motion motion;
  motion.frames.assign(3, RestPose(smpl));
  for (const Contacts& contacts : DetectContacts(smpl, motion))
    EXPECT_EQ(contacts, (Contacts{1, 1, 1, 1}));
  motion.frames[0].root_position.y() += 0.5;
  EXPECT_EQ(DetectContacts(smpl, motion)[0], (Contacts{0, 0, 0, 0}));
  EXPECT_TRUE(DetectContacts(smpl, Motion{}).empty());
}

TEST(Contacts, NeedAllFourFeet) {
  Skeleton skeleton = Skeleton::Smpl24();
  skeleton.feet[2] = -1;
  EXPECT_THROW(ContactDetector{skeleton}, Error);
}

TEST(Resample, KeepsCommonFramesAndInterpolatesBetweenThem) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const Motion motion = fixtures::SmoothMotion(smpl, 1, 61);
  const Motion doubled = Resample(motion, 60);
  ASSERT_EQ(doubled.frames.size(), 121U);
  for (size_t frame = 0; frame < motion.frames.size(); ++frame) {
    const Pose& pose = doubled.frames[2 * frame];
    EXPECT_EQ(pose.root_position, motion.frames[frame].root_position);
    EXPECT_LT((pose.rotations - motion.frames[frame].rotations).norm(), 1e-9);
  }
  const Pose& between = doubled.frames[21];
  EXPECT_LT((between.root_position -
             0.5 * (motion.frames[10].root_position + motion.frames[11].root_position))
                .norm(),
            1e-12);
  for (int joint = 0; joint < smpl.joints(); ++joint) {
    const Eigen::Vector3d a = motion.frames[10].rotations.col(joint);
    const Eigen::Vector3d b = motion.frames[11].rotations.col(joint);
    EXPECT_NEAR(RotationDifference(a, between.rotations.col(joint)).norm(),
                0.5 * RotationDifference(a, b).norm(), 1e-9);
  }
  const Motion back = Resample(doubled, 30);
  ASSERT_EQ(back.frames.size(), motion.frames.size());
  EXPECT_LT((back.frames[60].rotations - motion.frames[60].rotations).norm(), 1e-9);
}

TEST(Resample, StaysContinuousThroughManyTurns) {
  const Skeleton& smpl = Skeleton::Smpl24();
  Motion motion = fixtures::SmoothMotion(smpl, 2, 600);
  for (const double fps : {24.0, 25.0, 59.94, 120.0}) {
    const Motion resampled = Resample(motion, fps);
    EXPECT_EQ(resampled.frames.size(), static_cast<size_t>(Duration(motion) * fps + 1e-6) + 1);
    for (size_t frame = 1; frame < resampled.frames.size(); ++frame) {
      ASSERT_LT((resampled.frames[frame].rotations - resampled.frames[frame - 1].rotations)
                    .cwiseAbs()
                    .maxCoeff(),
                0.5);
    }
    EXPECT_GT(resampled.frames.back().rotations.col(0).norm(), 12);
  }
}

TEST(Resample, HoldsItsEndsAndRefusesNonsense) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const Motion motion = fixtures::SmoothMotion(smpl, 3, 10);
  EXPECT_EQ(PoseAt(motion, -1).rotations, motion.frames.front().rotations);
  EXPECT_EQ(PoseAt(motion, 100).rotations, motion.frames.back().rotations);
  EXPECT_THROW(PoseAt(Motion{}, 0), Error);
  EXPECT_THROW(Resample(motion, 0), Error);
  EXPECT_THROW(Resample(motion, std::nan("")), Error);
  EXPECT_TRUE(Resample(Motion{}, 60).frames.empty());
}

TEST(JointJerkTest, IsTheThirdDerivative) {
  const auto at = [](double s) { return Eigen::Vector3d(s * s * s, 5 * s * s, 7 - 2 * s * s * s); };
  EXPECT_NEAR(JointJerk(at(0), at(0.1), at(0.2), at(0.3), 10), 6 * std::sqrt(5.0), 1e-9);
}

}  // namespace choreo::locomotion_test
