#include "model/plan/plan_stages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/motion/kinematics/kinematics.h"

namespace choreo::plan_stages_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

double Bent(const Hinge& hinge, double bend) {
  std::vector<Pose> plan = {RestPose(Body())};
  plan[0].rotations.col(hinge.joint) = bend * hinge.axis;
  LimitHinges({.skeleton = Body(), .history = {}, .fps = 30}, &plan);
  return hinge.axis.dot(plan[0].rotations.col(hinge.joint));
}

TEST(LimitHinges, HingesStopSoftlyWhenStraight) {
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

TEST(LimitHinges, OtherJointsAndAxesStay) {
  Pose before = RestPose(Body());
  before.rotations.setConstant(0.3);
  std::vector<Pose> plan = {before};
  LimitHinges({.skeleton = Body(), .history = {}, .fps = 30}, &plan);
  for (int j = 0; j < Body().joints(); ++j) {
    Eigen::Vector3d change = plan[0].rotations.col(j) - before.rotations.col(j);
    for (const Hinge& hinge : Hinges(Body())) {
      if (hinge.joint == j) change -= hinge.axis * hinge.axis.dot(change);
    }
    EXPECT_LT(change.norm(), 1e-12);
  }
}

TEST(ReturnToFloor, LowersAFloatingDanceAlone) {
  for (const double height : {0.2, 0.0, -0.1}) {
    std::vector<Pose> poses(60, RestPose(Body()));
    for (Pose& pose : poses) pose.root_position.y() += height;
    const double first = poses.front().root_position.y();
    const std::vector<Pose> before = poses;
    ReturnToFloor({.skeleton = Body(), .history = {}, .keyed = true, .fps = 30}, &poses);
    EXPECT_EQ(poses.back().root_position, before.back().root_position) << "a key says where";
    ReturnToFloor({.skeleton = Body(), .history = {}, .fps = 30}, &poses);
    EXPECT_NEAR(poses.back().root_position.y(), RestPose(Body()).root_position.y(), 1e-9);
    EXPECT_NEAR(poses.front().root_position.y(), first, 1e-3);
  }
}

TEST(LimitHinges, LimbsDoNotFoldThroughThemselves) {
  for (const Hinge& hinge : Hinges(Body())) {
    double before = 0;
    for (double bend = 2; bend < 3.5; bend += 0.1) {
      const double now = Bent(hinge, bend);
      EXPECT_LE(now, 2.7);
      EXPECT_GE(now, before - 1e-12) << "it goes on bending, ever less";
      if (bend < 2.55) {
        EXPECT_NEAR(now, bend, 1e-2);
      }
      before = now;
    }
  }
}

TEST(PlanStages, AllAreApplied) {
  // It floats, has its knees bent backwards, and waves without a beat.
  std::vector<Pose> plan(60, RestPose(Body()));
  for (size_t i = 0; i < plan.size(); ++i) {
    plan[i].root_position.y() += 0.2;
    plan[i].rotations.col(16) << 0, 0, 0.02 * static_cast<double>(i);
    for (const Hinge& hinge : Hinges(Body())) plan[i].rotations.col(hinge.joint) = -hinge.axis;
  }
  const std::vector<double> beats = {-7, 8, 23, 38, 53, 68};
  const std::vector<Pose> history(2, plan.front()), before = plan;
  const PlanContext context{.skeleton = Body(), .history = history, .beats = beats, .fps = 30};
  for (const auto stage : kPlanStages) stage(context, &plan);
  EXPECT_LT(plan.back().root_position.y(), before.back().root_position.y() - 0.1);
  for (const Hinge& hinge : Hinges(Body()))
    EXPECT_GT(hinge.axis.dot(plan[30].rotations.col(hinge.joint)), -1e-6);
  EXPECT_GT((plan[30].rotations.col(16) - before[30].rotations.col(16)).norm(), 1e-3);
}

}  // namespace choreo::plan_stages_test
