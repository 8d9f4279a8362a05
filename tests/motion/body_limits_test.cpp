#include "model/motion/body_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/motion/kinematics.h"

namespace choreo {
namespace {

const Skeleton& Body() { return Skeleton::Smpl24(); }

double Bent(const Hinge& hinge, double bend) {
  Pose pose = RestPose(Body());
  pose.rotations.col(hinge.joint) = bend * hinge.axis;
  LimitHinges(Body(), {&pose, 1});
  return hinge.axis.dot(pose.rotations.col(hinge.joint));
}

TEST(BodyLimits, HingesStopSoftlyWhereTheyAreStraight) {
  const std::vector<Hinge> hinges = Hinges(Body());
  ASSERT_EQ(hinges.size(), 4U);
  for (const Hinge& hinge : hinges) {
    double before = 0;
    for (double bend = -1; bend < 2; bend += 0.01) {
      const double limited = Bent(hinge, bend);
      EXPECT_GE(limited, -1e-12);
      EXPECT_GE(limited, before - 1e-12) << bend;
      EXPECT_LE(limited - before, 0.0101);
      EXPECT_NEAR(limited, bend, bend > 0.15 ? 1e-3 : 2);
      before = limited;
    }
  }
}

TEST(BodyLimits, WhatIsNoHingeAndWhatTurnsAboutOtherAxesStays) {
  Pose pose = RestPose(Body());
  pose.rotations.setConstant(0.3);
  const Pose before = pose;
  LimitHinges(Body(), {&pose, 1});
  for (int j = 0; j < Body().joints(); ++j) {
    Eigen::Vector3d change = pose.rotations.col(j) - before.rotations.col(j);
    for (const Hinge& hinge : Hinges(Body())) {
      if (hinge.joint == j) change -= hinge.axis * hinge.axis.dot(change);
    }
    EXPECT_LT(change.norm(), 1e-12);
  }
}

TEST(BodyLimits, AFloatingDanceComesDownAndOneOnTheFloorStays) {
  for (const double height : {0.2, 0.0, -0.1}) {
    std::vector<Pose> poses(60, RestPose(Body()));
    for (Pose& pose : poses) pose.root_position.y() += height;
    const double first = poses.front().root_position.y();
    ReturnToFloor(Body(), poses);
    EXPECT_NEAR(poses.back().root_position.y(), RestPose(Body()).root_position.y(), 1e-9);
    EXPECT_NEAR(poses.front().root_position.y(), first, 1e-3);
  }
}

TEST(LimitHinges, NoLimbFoldsThroughItself) {
  for (const Hinge& hinge : Hinges(Body())) {
    double before = 0;
    for (double bend = 2; bend < 3.5; bend += 0.1) {
      Pose pose = RestPose(Body());
      pose.rotations.col(hinge.joint) = bend * hinge.axis;
      LimitHinges(Body(), {&pose, 1});
      const double now = hinge.axis.dot(pose.rotations.col(hinge.joint));
      EXPECT_LE(now, 2.7);
      EXPECT_GE(now, before - 1e-12) << "it goes on bending, ever less";
      if (bend < 2.55) {
        EXPECT_NEAR(now, bend, 1e-2);
      }
      before = now;
    }
  }
}

}  // namespace
}  // namespace choreo
