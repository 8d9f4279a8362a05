#include "model/motion/leg.h"

#include <gtest/gtest.h>

#include "model/core/random.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

const Skeleton& Body() { return Skeleton::Smpl24(); }

Pose Crouch(double bend) {
  Pose pose = RestPose(Body());
  for (const Leg& leg : Leg::Of(Body())) {
    pose.rotations.col(leg.hip).x() = -bend;
    pose.rotations.col(leg.knee).x() = 2 * bend;
    pose.rotations.col(leg.ankle).x() = -bend;
  }
  return pose;
}

TEST(Leg, ToesGoWhereTheyAreAskedAndTheFootKeepsItsTurn) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    Pose pose = Crouch(0.3);
    for (double& value : pose.rotations.reshaped()) value += 0.1 * random.Normal();
    const JointPlacement before = ForwardKinematics(Body(), pose);
    const Leg leg = Leg::Of(Body())[static_cast<size_t>(trial % 2)];
    const Eigen::Vector3d toes =
        before.positions.col(leg.toes) +
        0.04 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
    if (Reach(leg, before, toes) > 0.99) continue;
    Pose placed = pose;
    PlaceToes(leg, Body(), before, toes, &placed);
    const JointPlacement after = ForwardKinematics(Body(), placed);
    EXPECT_LT((after.positions.col(leg.toes) - toes).norm(), 1e-9);
    EXPECT_LT((after.rotations[static_cast<size_t>(leg.ankle)] -
               before.rotations[static_cast<size_t>(leg.ankle)])
                  .norm(),
              1e-9);
    for (int joint = 0; joint < Body().joints(); ++joint) {
      if (joint == leg.hip || joint == leg.knee || joint == leg.ankle) continue;
      EXPECT_EQ(placed.rotations.col(joint), pose.rotations.col(joint)) << joint;
    }
  }
}

TEST(Leg, AStraightLegBendsItsKneeForward) {
  const Pose pose = RestPose(Body());
  const JointPlacement before = ForwardKinematics(Body(), pose);
  for (const Leg& leg : Leg::Of(Body())) {
    Pose placed = pose;
    PlaceToes(leg, Body(), before, before.positions.col(leg.toes) + Eigen::Vector3d(0, 0.1, 0),
              &placed);
    const Eigen::Matrix3Xd after = JointPositions(Body(), placed);
    EXPECT_GT(after(2, leg.knee), before.positions(2, leg.knee) + 0.05);
    EXPECT_NEAR(after(1, leg.toes), before.positions(1, leg.toes) + 0.1, 1e-9);
  }
}

TEST(Leg, OutOfReachItStretchesTowardsTheGoal) {
  const Pose pose = Crouch(0.4);
  const JointPlacement before = ForwardKinematics(Body(), pose);
  const Leg leg = Leg::Of(Body())[0];
  const Eigen::Vector3d toes = before.positions.col(leg.toes) + Eigen::Vector3d(1, -0.5, 0);
  EXPECT_GT(Reach(leg, before, toes), 1);
  Pose placed = pose;
  PlaceToes(leg, Body(), before, toes, &placed);
  const JointPlacement after = ForwardKinematics(Body(), placed);
  EXPECT_NEAR(Reach(leg, after, after.positions.col(leg.toes)), 0.9995, 1e-6);
  const Eigen::Vector3d ankle =
      toes - (before.positions.col(leg.toes) - before.positions.col(leg.ankle));
  const Eigen::Vector3d wanted = (ankle - before.positions.col(leg.hip)).normalized();
  const Eigen::Vector3d got =
      (after.positions.col(leg.ankle) - after.positions.col(leg.hip)).normalized();
  EXPECT_LT((wanted - got).norm(), 1e-6);
}

TEST(Leg, ASkeletonWithoutLegsIsKnown) {
  EXPECT_TRUE(Leg::In(Body()));
  Skeleton other = Body();
  other.feet[1] = -1;
  EXPECT_FALSE(Leg::In(other));
}

}  // namespace
}  // namespace choreo
