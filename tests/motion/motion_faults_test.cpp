#include "model/motion/pose/motion_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/motion/floor/support.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo::motion_faults_test {

using testing::ElementsAre;
using testing::IsEmpty;

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// Three seconds of standing at ease, which `change` alters in each frame, given its second.
Motion Stands(
    const std::function<void(double, Pose*)>& change = [](double, Pose*) {}, double fps = 30) {
  Motion motion;
  motion.fps = fps;
  for (int frame = 0; frame < 3 * fps; ++frame)
    change(frame / fps, &motion.frames.emplace_back(StandingPose(Body())));
  return motion;
}

std::vector<MotionFault> FaultsOf(const Motion& motion) { return FindMotionFaults(Body(), motion); }

/// The only fault of a motion.
MotionFault FaultOf(const Motion& motion) {
  const std::vector<MotionFault> faults = FaultsOf(motion);
  EXPECT_EQ(faults.size(), 1U) << CountMotionFaults(faults);
  return faults.empty() ? MotionFault() : faults.front();
}

std::string Named(const MotionFault& fault) {
  return std::string(fault.row().name) + " " + Body().joint_names[static_cast<size_t>(fault.joint)];
}

/// 0 up to second 1, 1 from second 2 on, and smooth between.
double Ramp(double seconds) {
  const double u = std::clamp(seconds - 1, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

// The left arm is down, and its forearm turns inwards: before the body (0), or through it (0.8).
void TurnLeftArm(double turn, Pose* pose) {
  const double inwards = 0.8 * turn - 0.8;
  pose->rotations.col(Body().left_shoulder) =
      LogMap(ExpMap({0, 0, -1.3}) * ExpMap({0, inwards, 0}));
  pose->rotations.col(Body().left_elbow) = LogMap(ExpMap({0, 0, -1.4}));
}

TEST(MotionFaults, ABodyThatStandsAndWalksHasNone) {
  EXPECT_THAT(FaultsOf(Stands()), IsEmpty());
  EXPECT_THAT(FaultsOf(Motion()), IsEmpty());
  const Motion turns = Stands([](double seconds, Pose* pose) {
    pose->rotations.col(0) = Eigen::Vector3d(0, Ramp(seconds), 0);
  });
  EXPECT_THAT(FaultsOf(turns), IsEmpty());
}

TEST(MotionFaults, AnArmGoesThroughTheTrunk) {
  const MotionFault fault =
      FaultOf(Stands([](double seconds, Pose* pose) { TurnLeftArm(0.8 * Ramp(seconds), pose); }));
  EXPECT_EQ(Named(fault), "arm_inside left_wrist");
  EXPECT_GT(fault.first, 30);
  EXPECT_LT(fault.worst, 0.05);
  EXPECT_THAT(Describe(Body(), fault), testing::StartsWith("left_wrist: the arm is "));
}

TEST(MotionFaults, ABodyFloatsUnlessItFalls) {
  const MotionFault fault = FaultOf(
      Stands([](double seconds, Pose* pose) { pose->root_position.y() += 0.3 * Ramp(seconds); }));
  EXPECT_EQ(Named(fault), "floating pelvis");
  EXPECT_EQ(fault.last, 89);
  EXPECT_NEAR(fault.worst, 0.3, 1e-3);
  const Motion jumps = Stands([](double seconds, Pose* pose) {
    const double t = seconds - 1;
    pose->root_position.y() += std::max(0.0, 0.5 * kGravity * t * (0.6 - t));
  });
  EXPECT_THAT(FaultsOf(jumps), IsEmpty());
  const Motion lies = Stands([](double, Pose* pose) {
    pose->rotations.col(0) = Eigen::Vector3d(-M_PI / 2, 0, 0);
    pose->root_position.y() = 0.12;
  });
  for (const MotionFault& one : FaultsOf(lies)) EXPECT_NE(one.kind, MotionFaultKind::kFloating);
}

TEST(MotionFaults, FeetSlideOverTheFloor) {
  const std::vector<MotionFault> faults = FaultsOf(
      Stands([](double seconds, Pose* pose) { pose->root_position.x() += 0.4 * Ramp(seconds); }));
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(Named(faults[0]), "sliding left_foot");
  EXPECT_EQ(Named(faults[1]), "sliding right_foot");
  EXPECT_GT(faults[0].worst, 0.3);
  EXPECT_LE(faults[0].worst, 0.4);
  EXPECT_EQ(CountMotionFaults(faults), "2 faults: 2 foot sliding");
}

TEST(MotionFaults, ABodySinksIntoTheFloor) {
  const MotionFault fault = FaultOf(
      Stands([](double seconds, Pose* pose) { pose->root_position.y() -= 0.1 * Ramp(seconds); }));
  EXPECT_EQ(fault.kind, MotionFaultKind::kUnderFloor);
  EXPECT_NEAR(fault.worst, 0.1, 0.02);
  EXPECT_EQ(fault.last, 89);
}

TEST(MotionFaults, ALimbSnaps) {
  const auto bends_at = [](double from, double seconds) {
    return [=](double now, Pose* pose) {
      const double share = std::clamp((now - from) / seconds, 0.0, 1.0);
      pose->rotations.col(Body().left_elbow) += Eigen::Vector3d(0, -2.7 * share, 0);
    };
  };
  EXPECT_THAT(FaultsOf(Stands(bends_at(1, 0.3))), IsEmpty());
  const MotionFault fault = FaultOf(Stands(bends_at(1, 0.03)));
  EXPECT_EQ(Named(fault), "snap left_wrist");
  EXPECT_GE(fault.first, 29);
  EXPECT_LE(fault.last, 32);
  // Counts in the motion's own frames.
  const MotionFault fast = FaultOf(Stands(bends_at(1, 0.03), 60));
  EXPECT_EQ(fast.kind, MotionFaultKind::kSnap);
  EXPECT_NEAR(static_cast<double>(fast.first), 60, 4);
  const MotionFault slow = FaultOf(Stands(bends_at(1, 0.03), 15));
  EXPECT_EQ(slow.kind, MotionFaultKind::kSnap);
  EXPECT_NEAR(static_cast<double>(slow.first), 15, 2);
}

TEST(MotionFaults, HaveAllTheirFramesAtOtherRates) {
  const auto frames = [](double to) {
    const MotionFault moved = AtRate({.first = 3, .last = 4}, 30, to);
    return std::pair(moved.first, moved.last);
  };
  EXPECT_EQ(frames(60), std::pair(int64_t{6}, int64_t{9}));
  EXPECT_EQ(frames(30), std::pair(int64_t{3}, int64_t{4}));
  EXPECT_EQ(frames(7.5), std::pair(int64_t{1}, int64_t{1}));
}

TEST(MotionFaults, StretchesThatAreNearCountAsOne) {
  const auto sinks = [](double apart) {
    return Stands([=](double seconds, Pose* pose) {
      const bool is_up = seconds < 0.5 || (seconds > 1 && seconds < 1 + apart);
      if (!is_up) pose->root_position.y() -= 0.1;
    });
  };
  EXPECT_EQ(FaultsOf(sinks(0.1)).size(), 1U);
  EXPECT_EQ(FaultsOf(sinks(0.5)).size(), 2U);
}

TEST(MotionFaults, ASkeletonWithoutRolesHasThoseOfItsJointsAlone) {
  Skeleton stick;
  stick.name = "stick";
  stick.AddJoint("root", -1, Eigen::Vector3d::Zero());
  stick.AddJoint("tip", 0, Eigen::Vector3d(0, 0.5, 0));
  stick.StandOnFloor();
  Motion motion;
  Pose pose = RestPose(stick);
  pose.root_position.y() = -0.5;
  motion.frames.assign(30, pose);
  EXPECT_THAT(FindMotionFaults(stick, motion),
              ElementsAre(testing::Field(&MotionFault::kind, MotionFaultKind::kUnderFloor)));
}

TEST(FaultShare, CountsEachFrameOnce) {
  const std::vector<MotionFault> faults = {{MotionFaultKind::kArmInside, 0, 9},
                                           {MotionFaultKind::kArmInside, 5, 14},
                                           {MotionFaultKind::kSnap, 20, 20}};
  EXPECT_DOUBLE_EQ(FaultShare(faults, MotionFaultKind::kArmInside, 30), 0.5);
  EXPECT_DOUBLE_EQ(FaultShare(faults, MotionFaultKind::kFloating, 30), 0);
  EXPECT_EQ(CountMotionFaults(faults), "3 faults: 2 arm inside the trunk, 1 snap");
  EXPECT_EQ(CountMotionFaults({}), "no faults");
}

}  // namespace choreo::motion_faults_test
