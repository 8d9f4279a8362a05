#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/core/numbers/random.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/nearest_points.h"
#include "model/motion/rotation.h"
#include "model/plan/plan_stages.h"

namespace choreo::arm_clearance_test {

constexpr double kFps = 30;
constexpr int kFrames = 60;

const Skeleton& Body() { return Skeleton::Smpl24(); }

// The distance of the left forearm from the line through the trunk.
double Distance(const Pose& pose) {
  const Eigen::Matrix3Xd at = JointPositions(Body(), pose);
  const auto joint = [&](const char* name) -> Eigen::Vector3d { return at.col(Body().Find(name)); };
  const auto [on_trunk, on_arm] = NearestPoints<Eigen::Vector3d>(
      joint("pelvis"), joint("spine3"), joint("left_elbow"), joint("left_wrist"));
  return ((1 - on_trunk) * joint("pelvis") + on_trunk * joint("spine3") -
          (1 - on_arm) * joint("left_elbow") - on_arm * joint("left_wrist"))
      .norm();
}

// Stands with the left arm down and its forearm turned inwards, before the body (turn 0), through
// it (0.5) or behind it (2).
Pose Arm(double turn) {
  Pose pose = RestPose(Body());
  const double inwards = 0.8 * turn - 0.8;
  pose.rotations.col(Body().left_shoulder) = LogMap(ExpMap({0, 0, -1.3}) * ExpMap({0, inwards, 0}));
  pose.rotations.col(Body().left_elbow) = LogMap(ExpMap({0, 0, -1.4}));
  return pose;
}

std::vector<Pose> Swing(double from, double to) {
  std::vector<Pose> plan;
  for (int i = 0; i < kFrames; ++i) {
    const double share = std::clamp((i - 15) / 30.0, 0.0, 1.0);
    plan.push_back(Arm(from + share * (to - from)));
  }
  return plan;
}

double Nearest(const std::vector<Pose>& plan) {
  double nearest = 1;
  for (const Pose& pose : plan) nearest = std::min(nearest, Distance(pose));
  return nearest;
}

void Keep(bool keyed, std::vector<Pose>* plan) {
  const std::vector<Pose> history(10, plan->front());
  KeepArmsOutside({.skeleton = Body(), .history = history, .keyed = keyed, .fps = kFps}, plan);
}

TEST(KeepArmsOutside, AnArmGoesRoundTheTrunk) {
  std::vector<Pose> plan = Swing(0, 2);
  ASSERT_LT(Nearest(plan), 0.06);
  Keep(false, &plan);
  EXPECT_GT(Nearest(plan), 0.8 * kTrunkDepth);
}

TEST(KeepArmsOutside, ItMovesAsideSmoothly) {
  std::vector<Pose> plan = Swing(0, 2);
  const auto most = [](const std::vector<Pose>& poses) {
    double fastest = 0;
    for (size_t i = 1; i < poses.size(); ++i) {
      const Eigen::Matrix3Xd a = JointPositions(Body(), poses[i - 1]),
                             b = JointPositions(Body(), poses[i]);
      fastest = std::max(fastest, (b - a).colwise().norm().maxCoeff() * kFps);
    }
    return fastest;
  };
  const double before = most(plan);
  Keep(false, &plan);
  ASSERT_GT(Nearest(plan), 0.8 * kTrunkDepth);
  EXPECT_LT(most(plan), before + 2);
}

// A quick arm has no time to go round: it stays a little inside, but its shoulder does not whirl.
TEST(KeepArmsOutside, AQuickArmDoesNotWhirl) {
  const auto fastest = [](const std::vector<Pose>& plan) {
    double most = 0;
    for (size_t i = 1; i < plan.size(); ++i)
      most = std::max(most, RotationDifference(plan[i - 1].rotations.col(Body().left_shoulder),
                                               plan[i].rotations.col(Body().left_shoulder))
                                .norm());
    return most * kFps;
  };
  Random random(1);
  for (int dance = 0; dance < 200; ++dance) {
    std::vector<Pose> plan(kFrames, RestPose(Body()));
    for (const int joint : {Body().left_shoulder, Body().left_elbow}) {
      for (int axis = 0; axis < 3; ++axis) {
        const double phase = random.Uniform(0, 2 * M_PI), pace = random.Uniform(0.1, 0.4);
        for (int i = 0; i < kFrames; ++i)
          plan[static_cast<size_t>(i)].rotations(axis, joint) = 1.2 * std::sin(phase + pace * i);
      }
    }
    const double before = fastest(plan);
    Keep(true, &plan);
    EXPECT_LT(fastest(plan), std::max(before, 20.0) + 1e-6) << dance;
  }
}

TEST(KeepArmsOutside, ArmsThatAreOutsideStay) {
  std::vector<Pose> plan = Swing(0, 0);
  ASSERT_GT(Nearest(plan), kTrunkDepth);
  const std::vector<Pose> before = plan;
  Keep(false, &plan);
  for (size_t i = 0; i < plan.size(); ++i) EXPECT_EQ(plan[i].rotations, before[i].rotations);
}

TEST(KeepArmsOutside, TheRightArmMovesAsTheLeft) {
  std::vector<Pose> left = Swing(0, 2), right;
  for (const Pose& pose : left) right.push_back(Mirror(Body(), pose));
  Keep(false, &left);
  Keep(false, &right);
  for (Pose& pose : right) pose = Mirror(Body(), pose);
  EXPECT_GT(Nearest(right), 0.8 * kTrunkDepth);
  // SMPL's sides differ by centimetres.
  for (size_t i = 0; i < left.size(); ++i)
    EXPECT_LT(ComparePoses(Body(), right[i], left[i]).position_m, 0.1) << i;
}

TEST(KeepArmsOutside, OnlyOneShoulderTurns) {
  std::vector<Pose> plan = Swing(0, 2);
  const std::vector<Pose> before = plan;
  Keep(false, &plan);
  for (size_t i = 0; i < plan.size(); ++i) {
    for (int joint = 0; joint < Body().joints(); ++joint) {
      if (joint == Body().left_shoulder) continue;
      EXPECT_EQ(plan[i].rotations.col(joint), before[i].rotations.col(joint));
    }
  }
  const int shoulder = Body().left_shoulder;
  EXPECT_NE(plan[30].rotations.col(shoulder), before[30].rotations.col(shoulder));
}

// A key, and the pose before, may have a hand on the heart.
TEST(KeepArmsOutside, EndsStay) {
  std::vector<Pose> plan = Swing(0, 0.5);
  ASSERT_LT(Distance(plan.back()), 0.06);
  const Pose key = plan.back();
  Keep(true, &plan);
  EXPECT_EQ(plan.back().rotations, key.rotations);
  // No detour just before it, either.
  EXPECT_LT(std::abs(Distance(plan[kFrames - 2]) - Distance(key)), 0.02);
}

TEST(KeepArmsOutside, ASkeletonWithoutArmsIsLeftAlone) {
  Skeleton legs = Body();
  legs.left_elbow = -1;
  std::vector<Pose> plan = Swing(0, 2);
  const std::vector<Pose> before = plan, history(1, plan.front());
  KeepArmsOutside({.skeleton = legs, .history = history, .fps = kFps}, &plan);
  EXPECT_EQ(plan[30].rotations, before[30].rotations);
}

}  // namespace choreo::arm_clearance_test
