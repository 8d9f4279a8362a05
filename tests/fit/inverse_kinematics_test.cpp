#include "model/fit/solver/inverse_kinematics.h"

#include <gtest/gtest.h>

#include "model/motion/kinematics/kinematics.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo::inverse_kinematics_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// Upright, arms down, elbows and knees a little bent.
Pose Standing() {
  Pose pose = RestPose(Body());
  pose.rotations(2, Body().left_shoulder) = -1.2;
  pose.rotations(2, Body().right_shoulder) = 1.2;
  for (const Hinge& hinge : Hinges(Body())) pose.rotations.col(hinge.joint) = 0.2 * hinge.axis;
  return pose;
}

Eigen::Vector3d At(const Pose& pose, const std::string& joint) {
  return JointPositions(Body(), pose).col(Body().Find(joint));
}

JointTarget Target(const std::string& joint, const Eigen::Vector3d& position) {
  return {Body().Find(joint), position};
}

void ExpectSoundLimbs(const Pose& pose) {
  for (const Hinge& hinge : Hinges(Body())) {
    const double bend = hinge.axis.dot(pose.rotations.col(hinge.joint));
    EXPECT_GT(bend, -0.02) << Body().joint_names[static_cast<size_t>(hinge.joint)];
    EXPECT_LT(bend, 2.8) << Body().joint_names[static_cast<size_t>(hinge.joint)];
  }
}

TEST(DrawJoints, MeetsReachableTargetsWithPlantedFeet) {
  const Pose standing = Standing();
  for (const auto& [joint, place] : std::vector<std::pair<std::string, Eigen::Vector3d>>{
           {"right_hand", {-0.3, 1.6, 0.2}},
           {"right_hand", {0.2, 1.2, 0.3}},  // across
           {"left_hand", {0.3, 0.1, 0.4}},   // to the floor
           {"left_hand", {0.2, 2.0, 0.1}},   // up
           {"head", {0.1, 1.2, 0.4}},
           {"pelvis", {0.1, 0.6, 0}}}) {
    const DrawnPose drawn = DrawJoints(Body(), standing, std::vector{Target(joint, place)});
    ASSERT_EQ(drawn.missed_m.size(), 1U);
    EXPECT_LT(drawn.missed_m[0], 0.005) << joint << " to " << place.transpose();
    EXPECT_NEAR((At(drawn.pose, joint) - place).norm(), drawn.missed_m[0], 1e-9);
    for (const int foot : Body().feet) {
      const std::string& name = Body().joint_names[static_cast<size_t>(foot)];
      EXPECT_LT((At(drawn.pose, name) - At(standing, name)).norm(), 0.01) << name << joint;
    }
    ExpectSoundLimbs(drawn.pose);
  }
}

// Hands and head that stayed where they were twisted a body that crouched.
TEST(DrawJoints, TheUpperBodyFollowsThePelvis) {
  const Pose standing = Standing();
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(0, 0.6, 0), Eigen::Vector3d(0.1, 0.8, 0)}) {
    const DrawnPose drawn = DrawJoints(Body(), standing, std::vector{Target("pelvis", place)},
                                       UpperBody::kFollowsPelvis);
    EXPECT_LT(drawn.missed_m[0], 0.005);
    const Eigen::Vector3d way = place - At(standing, "pelvis");
    for (const char* joint : {"left_hand", "right_hand", "head"})
      EXPECT_LT((At(drawn.pose, joint) - At(standing, joint) - way).norm(), 0.05) << joint;
    for (const char* joint : {"spine2", "spine3", "left_collar", "right_collar"}) {
      const auto turn = static_cast<Eigen::Index>(Body().Find(joint));
      EXPECT_LT(drawn.pose.rotations.col(turn).norm(), 0.15) << joint;
    }
    ExpectSoundLimbs(drawn.pose);
  }
}

TEST(DrawJoints, AMovedFootKeepsItsRotation) {
  const Pose standing = Standing();
  const Eigen::Vector3d place = At(standing, "left_foot") + Eigen::Vector3d(0.3, 0, 0.3);
  const DrawnPose drawn = DrawJoints(Body(), standing, std::vector{Target("left_foot", place)});
  EXPECT_LT(drawn.missed_m[0], 0.005);
  EXPECT_NEAR(At(drawn.pose, "left_ankle").y(), At(standing, "left_ankle").y(), 0.02);
  EXPECT_LT((At(drawn.pose, "right_foot") - At(standing, "right_foot")).norm(), 0.01);
  ExpectSoundLimbs(drawn.pose);
}

TEST(DrawJoints, AnArmReachesBeforeTheTrunkLeans) {
  const Pose standing = Standing();
  const DrawnPose drawn =
      DrawJoints(Body(), standing, std::vector{Target("left_hand", {0.35, 1.35, 0.35})});
  EXPECT_LT((At(drawn.pose, "head") - At(standing, "head")).norm(), 0.06);
  EXPECT_LT((At(drawn.pose, "right_hand") - At(standing, "right_hand")).norm(), 0.06);
}

TEST(DrawJoints, ReportsTheFinalDistance) {
  const DrawnPose drawn =
      DrawJoints(Body(), Standing(), std::vector{Target("left_hand", {0.2, 4, 0})});
  EXPECT_GT(drawn.missed_m[0], 1.5);
  EXPECT_LT(drawn.missed_m[0], 2.2);
  EXPECT_TRUE(drawn.pose.rotations.allFinite());
}

TEST(DrawJoints, HardlyChangesAMetTarget) {
  const Pose standing = Standing();
  const DrawnPose drawn =
      DrawJoints(Body(), standing, std::vector{Target("left_hand", At(standing, "left_hand"))});
  EXPECT_LT(ComparePoses(Body(), drawn.pose, standing).position_m, 0.01);
  EXPECT_TRUE(DrawJoints(Body(), standing, {}).missed_m.empty());
}

TEST(DrawJoints, MeetsSeveralAtOnce) {
  const DrawnPose drawn = DrawJoints(
      Body(), Standing(),
      std::vector{Target("left_hand", {0.1, 1.1, 0.45}), Target("right_hand", {-0.1, 1.1, 0.45}),
                  Target("pelvis", {0, 0.75, -0.1})});
  for (const double missed : drawn.missed_m) EXPECT_LT(missed, 0.01);
  ExpectSoundLimbs(drawn.pose);
}

}  // namespace choreo::inverse_kinematics_test
