#include "model/motion/kinematics/limb.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "model/core/numbers/random.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo::leg_test {

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

TEST(Leg, ToesReachTheirTargetAndTheFootKeepsItsRotation) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    Pose pose = Crouch(0.5);
    for (double& value : pose.rotations.reshaped()) value += 0.1 * random.Normal();
    const JointPlacement before = ForwardKinematics(Body(), pose);
    const Leg leg = Leg::Of(Body())[static_cast<size_t>(trial % 2)];
    const Eigen::Vector3d toes =
        before.positions.col(leg.toes) +
        0.04 * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal());
    if (Reach(leg, before, toes) > 0.94) continue;  // it would straighten softly
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

// Degrees between thigh and shin; 0: in line.
double Flexion(const Leg& leg, const Pose& pose) {
  const Eigen::Matrix3Xd joints = JointPositions(Body(), pose);
  const Eigen::Vector3d thigh = joints.col(leg.knee) - joints.col(leg.hip);
  const Eigen::Vector3d shin = joints.col(leg.ankle) - joints.col(leg.knee);
  return std::atan2(thigh.cross(shin).norm(), thigh.dot(shin)) * 180 / M_PI;
}

// `pose` with its left toes displaced by `offset`.
Pose Moved(const Pose& pose, const Eigen::Vector3d& offset) {
  const Leg leg = Leg::Of(Body())[0];
  const JointPlacement before = ForwardKinematics(Body(), pose);
  Pose placed = pose;
  PlaceToes(leg, Body(), before, before.positions.col(leg.toes) + offset, &placed);
  return placed;
}

TEST(Leg, AStraightLegBendsItsKneeForward) {
  const Pose pose = RestPose(Body());
  const JointPlacement before = ForwardKinematics(Body(), pose);
  const Leg leg = Leg::Of(Body())[0];
  const Eigen::Matrix3Xd after = JointPositions(Body(), Moved(pose, {0, 0.2, 0}));
  EXPECT_GT(after(2, leg.knee), before.positions(2, leg.knee) + 0.05);
  EXPECT_NEAR(after(1, leg.toes), before.positions(1, leg.toes) + 0.2, 1e-9);
  // Where a straight leg begins to bend, it misses its target by little more than a centimetre.
  for (double up = 0; up < 0.2; up += 0.005) {
    const Eigen::Matrix3Xd near = JointPositions(Body(), Moved(pose, {0, up, 0}));
    EXPECT_NEAR(near(1, leg.toes), before.positions(1, leg.toes) + up, 0.012) << up;
  }
}

// Recorded and generated knees go slightly beyond straight. A knee that kept bending that way would
// break.
TEST(Leg, OverstretchedKneeBendsForward) {
  const Leg leg = Leg::Of(Body())[0];
  for (const double beyond : {0.02, 0.12, 0.2, 0.4}) {
    for (const double side : {-0.15, 0.0, 0.15}) {
      Pose pose = RestPose(Body());
      pose.rotations.col(leg.knee) = Eigen::Vector3d(-beyond, 0, side);
      for (double up = 0; up <= 0.15; up += 0.005) {
        const double knee = Moved(pose, {0, up, 0}).rotations(0, leg.knee);
        EXPECT_GE(knee, -beyond - 1e-9) << up;
        if (up > 0.1) {
          EXPECT_GT(knee, 0.3) << up;
        }
      }
    }
  }
}

// Through its full length and back, a leg never snaps: toes that move three millimetres (a tenth of
// a metre a second) turn the knee by less than three degrees.
TEST(Leg, StraightensSmoothlyTowardsAnyTarget) {
  const Leg leg = Leg::Of(Body())[0];
  for (const double bend : {-0.1, -0.055, 0.0, 0.1, 0.2, 0.4}) {
    const Pose pose = Crouch(bend);
    for (const Eigen::Vector3d& way :
         {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0.6, 0.8, 0), Eigen::Vector3d(0, 0.6, -0.8)}) {
      double last = Flexion(leg, Moved(pose, -0.2 * way));
      for (double at = -0.197; at < 0.2; at += 0.003) {
        const double now = Flexion(leg, Moved(pose, at * way));
        EXPECT_LT(std::abs(now - last), 3) << bend << ' ' << at;
        last = now;
      }
    }
  }
}

TEST(Leg, MetTargetChangesNothing) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    // Near straight, on either side of it.
    Pose pose = Crouch(0.1 * random.Normal());
    for (double& value : pose.rotations.reshaped()) value += 0.05 * random.Normal();
    for (const double off : {0.0, 1e-6}) {
      const Pose placed = Moved(pose, {off, off, -off});
      EXPECT_LT((placed.rotations - pose.rotations).cwiseAbs().maxCoeff(), 1e-8 + 1e3 * off);
    }
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
  const double reach = Reach(leg, after, after.positions.col(leg.toes));
  EXPECT_GT(reach, 0.99);
  EXPECT_LT(reach, 1);
  const Eigen::Vector3d ankle =
      toes - (before.positions.col(leg.toes) - before.positions.col(leg.ankle));
  const Eigen::Vector3d wanted = (ankle - before.positions.col(leg.hip)).normalized();
  const Eigen::Vector3d got =
      (after.positions.col(leg.ankle) - after.positions.col(leg.hip)).normalized();
  EXPECT_LT((wanted - got).norm(), 1e-6);
}

TEST(Leg, LimitsTargetsToItsReach) {
  const Skeleton& body = Skeleton::Smpl24();
  const Leg leg = Leg::Of(body)[0];
  Pose pose = RestPose(body);
  pose.rotations.col(leg.knee).x() = 0.8;
  JointPlacement placement;
  ForwardKinematics(body, pose, placement);
  const Eigen::Vector3d toes = placement.positions.col(leg.toes);
  const Eigen::Vector3d near = toes + Eigen::Vector3d(0.02, 0, 0.01);
  EXPECT_EQ(WithinReach(leg, placement, near, 0.99), near);
  for (const Eigen::Vector3d& far : {Eigen::Vector3d(1, -0.2, 0.3), Eigen::Vector3d(0, -2, 0)}) {
    const Eigen::Vector3d at = WithinReach(leg, placement, toes + far, 0.99);
    EXPECT_NEAR(Reach(leg, placement, at), 0.99, 1e-9);
    // The nearest such point: straight towards the hip.
    const Eigen::Vector3d ankle = placement.positions.col(leg.ankle) + far;
    const Eigen::Vector3d back = (toes + far) - at;
    EXPECT_GT(back.dot(ankle - placement.positions.col(leg.hip)), 0);
    EXPECT_LT(back.cross(ankle - placement.positions.col(leg.hip)).norm(), 1e-9);
  }
  // A leg that is stretched more already may stay so, but not stretch further.
  const double stretched = Reach(leg, placement, toes);
  EXPECT_NEAR(Reach(leg, placement,
                    WithinReach(leg, placement, toes + Eigen::Vector3d(0, -1, 0), 0.5 * stretched)),
              stretched, 1e-9);
}

TEST(Leg, ASkeletonWithoutLegsIsKnown) {
  EXPECT_TRUE(Leg::In(Body()));
  Skeleton other = Body();
  other.feet[1] = -1;
  EXPECT_FALSE(Leg::In(other));
}

}  // namespace choreo::leg_test
