#include "model/motion/kinematics/kinematics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "model/core/error.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/rotation.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo::kinematics_test {

constexpr double kPi = std::numbers::pi;

Skeleton Chain() {
  Skeleton chain;
  chain.name = "chain";
  chain.joint_names = {"a", "b", "c"};
  chain.parents = {-1, 0, 1};
  chain.offsets.setZero(3, 3);
  chain.offsets.col(1) << 1, 0, 0;
  chain.offsets.col(2) << 2, 0, 0;
  chain.Check();
  return chain;
}

TEST(Kinematics, PlanarChainInClosedForm) {
  const Skeleton chain = Chain();
  for (const double first : {0.0, 0.3, -1.2}) {
    for (const double second : {0.0, 0.7, 2.5}) {
      Pose pose;
      pose.root_position = {0.5, 1, -2};
      pose.rotations.setZero(3, 3);
      pose.rotations(2, 0) = first;
      pose.rotations(2, 1) = second;
      const JointPlacement placement = ForwardKinematics(chain, pose);
      const Eigen::Vector3d elbow(0.5 + std::cos(first), 1 + std::sin(first), -2);
      const Eigen::Vector3d tip =
          elbow + 2 * Eigen::Vector3d(std::cos(first + second), std::sin(first + second), 0);
      EXPECT_LT((placement.positions.col(1) - elbow).norm(), 1e-12);
      EXPECT_LT((placement.positions.col(2) - tip).norm(), 1e-12);
      EXPECT_LT((placement.rotations[2] - ExpMap({0, 0, first + second})).norm(), 1e-12);
    }
  }
}

TEST(Kinematics, AStandingBodyHasItsHandsBesideTheHips) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const Pose standing = StandingPose(smpl), rest = RestPose(smpl);
  const Eigen::Matrix3Xd at = JointPositions(smpl, standing), before = JointPositions(smpl, rest);
  for (const int foot : smpl.feet) EXPECT_LT((at.col(foot) - before.col(foot)).norm(), 1e-12);
  for (const char* name : {"left_wrist", "right_wrist"}) {
    const Eigen::Vector3d wrist = at.col(smpl.Find(name));
    EXPECT_LT(std::abs(wrist.y() - smpl.pelvis_height), 0.12) << name;
    EXPECT_GT(std::abs(wrist.x()), 0.2) << name << " is not inside the body";
    EXPECT_LT(std::abs(wrist.x()), 0.5) << name;
    EXPECT_GT(wrist.z(), 0) << name << ": elbows bend forwards";
  }
}

TEST(Kinematics, ABodyWithoutElbowsStandsAtRest) {
  const Skeleton chain = Chain();
  EXPECT_EQ(StandingPose(chain).rotations, RestPose(chain).rotations);
}

TEST(Kinematics, APoseStandsWithItsLowestFootOnTheFloor) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const Pose rest = RestPose(smpl);
  EXPECT_DOUBLE_EQ(*StandingHeight(smpl, rest), smpl.pelvis_height);
  Pose crouch = rest;
  for (const int hip : {smpl.left_hip, smpl.right_hip}) crouch.rotations(0, hip) = -1.2;
  for (const int knee : {smpl.left_knee, smpl.right_knee}) crouch.rotations(0, knee) = 2.0;
  const double height = *StandingHeight(smpl, crouch);
  EXPECT_LT(height, smpl.pelvis_height - 0.2);
  crouch.root_position = {3, height, -2};
  EXPECT_EQ(*StandingHeight(smpl, crouch), height) << "wherever the pose is said to be";
  const Eigen::Matrix3Xd at_rest = JointPositions(smpl, rest),
                         crouched = JointPositions(smpl, crouch);
  double lowest = 1;
  for (const int foot : smpl.feet) lowest = std::min(lowest, crouched(1, foot) - at_rest(1, foot));
  EXPECT_NEAR(lowest, 0, 1e-12);
  // One leg bent: the other one carries.
  Pose kick = rest;
  kick.rotations(0, smpl.left_hip) = -1.5;
  EXPECT_DOUBLE_EQ(*StandingHeight(smpl, kick), smpl.pelvis_height);
}

TEST(Kinematics, MaskedLegsHaveNoStandingHeight) {
  const Skeleton& smpl = Skeleton::Smpl24();
  PoseMask mask;
  mask.joints.assign(24, true);
  mask.joints[static_cast<size_t>(smpl.left_shoulder)] = false;
  EXPECT_TRUE(StandingHeight(smpl, RestPose(smpl), mask));
  mask.joints[static_cast<size_t>(smpl.left_knee)] = false;
  EXPECT_FALSE(StandingHeight(smpl, RestPose(smpl), mask));
  Pose chain;
  chain.rotations.setZero(3, 3);
  EXPECT_FALSE(StandingHeight(Chain(), chain)) << "a skeleton without feet";
}

TEST(Kinematics, MaskedKeyTakesTheOtherPoseWhereOpen) {
  const Skeleton& smpl = Skeleton::Smpl24();
  std::mt19937 generator(1);
  const Pose key = fixtures::RandomPose(smpl, generator),
             open = fixtures::RandomPose(smpl, generator);
  const Pose every_joint = Masked(key, {.root_position = false, .joints = {}}, open);
  EXPECT_EQ(every_joint.root_position, open.root_position);
  EXPECT_EQ(every_joint.rotations, key.rotations);
  PoseMask mask;
  mask.joints.assign(24, false);
  mask.joints[7] = true;
  const Pose one = Masked(key, mask, open);
  EXPECT_EQ(one.root_position, key.root_position);
  for (int joint = 0; joint < 24; ++joint)
    EXPECT_EQ(one.rotations.col(joint), (joint == 7 ? key : open).rotations.col(joint));
}

TEST(Kinematics, SmplStandsOnTheFloorAtRest) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const Eigen::Matrix3Xd rest = JointPositions(smpl, RestPose(smpl));
  EXPECT_NEAR(rest.row(1).minCoeff(), 0.02, 1e-9);
  for (const int foot : smpl.feet) EXPECT_LT(rest(1, foot), 0.1);
  EXPECT_GT(rest(1, smpl.Find("head")), 1.4);
  EXPECT_GT(rest(0, smpl.left_hip), 0);
  EXPECT_GT(rest(2, smpl.feet[1]), rest(2, smpl.feet[0]));
  EXPECT_EQ(smpl.joints(), 24);
}

TEST(Kinematics, BonesKeepTheirLengths) {
  const Skeleton& smpl = Skeleton::Smpl24();
  std::mt19937 generator(1);
  const Eigen::Matrix3Xd positions =
      JointPositions(smpl, fixtures::RandomPose(smpl, generator, 2.0));
  for (int joint = 1; joint < smpl.joints(); ++joint) {
    EXPECT_NEAR((positions.col(joint) - positions.col(smpl.parents[joint])).norm(),
                smpl.offsets.col(joint).norm(), 1e-12);
  }
}

TEST(Kinematics, RefusesAPoseOfAnotherSkeleton) {
  std::mt19937 generator(1);
  EXPECT_THROW(JointPositions(Chain(), fixtures::RandomPose(Skeleton::Smpl24(), generator)), Error);
}

TEST(Kinematics, ComparePosesMeasuresMaskedJointsAlone) {
  const Skeleton chain = Chain();
  Pose a;
  a.rotations.setZero(3, 3);
  Pose b = a;
  b.rotations(2, 1) = kPi / 2;
  b.root_position.x() = 0.25;
  // The tip moves by (-2, 2) and by the root's 0.25.
  PoseError error = ComparePoses(chain, a, b);
  EXPECT_NEAR(error.position_m, std::hypot(1.75, 2.0), 1e-12);
  EXPECT_NEAR(error.angle_deg, 90, 1e-9);
  error = ComparePoses(chain, a, b, {.root_position = false, .joints = {}});
  EXPECT_NEAR(error.position_m, std::sqrt(8.0), 1e-12);
  error = ComparePoses(chain, a, b, {.root_position = true, .joints = {true, false, true}});
  EXPECT_NEAR(error.position_m, 0.25, 1e-12);
  EXPECT_NEAR(error.angle_deg, 0, 1e-9);
  error = ComparePoses(chain, a, b, {.root_position = false, .joints = {false, true, false}});
  EXPECT_EQ(error.position_m, 0);
  EXPECT_NEAR(error.angle_deg, 90, 1e-9);
  EXPECT_THROW(ComparePoses(chain, a, b, {.root_position = true, .joints = {true}}), Error);
}

TEST(Skeleton, CheckNamesTheFirstInvalidJoint) {
  Skeleton broken = Chain();
  broken.parents[1] = 2;
  try {
    broken.Check();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.field(), "skeleton.parents[1]");
  }
  broken = Chain();
  broken.joint_names[2] = "a";
  EXPECT_THROW(broken.Check(), Error);
  broken = Chain();
  broken.offsets(0, 0) = 1;
  EXPECT_THROW(broken.Check(), Error);
  broken = Chain();
  broken.offsets(0, 1) = std::nan("");
  EXPECT_THROW(broken.Check(), Error);
  broken = Chain();
  broken.left_knee = 3;
  EXPECT_THROW(broken.Check(), Error);
}

// Moving and turning the scene.
Pose Moved(const Pose& pose, double turn, const Eigen::Vector3d& shift) {
  return GroundFrame{.origin = shift, .heading = turn}.ToWorld(pose);
}

TEST(GroundFrame, LocalPoseDoesNotChangeWhenTheSceneIsMovedAndTurned) {
  const Skeleton& smpl = Skeleton::Smpl24();
  std::mt19937 generator(2);
  for (int repeat = 0; repeat < 30; ++repeat) {
    const Pose base = fixtures::RandomPose(smpl, generator);
    const Pose other = fixtures::RandomPose(smpl, generator);
    const double turn = 3 * fixtures::RandomVector(generator, 1).x();
    Eigen::Vector3d shift = fixtures::RandomVector(generator, 5);
    shift.y() = 0;
    const Pose local = GroundFrame::Of(base).ToLocal(other);
    const Pose moved_local =
        GroundFrame::Of(Moved(base, turn, shift)).ToLocal(Moved(other, turn, shift));
    EXPECT_LT((JointPositions(smpl, local) - JointPositions(smpl, moved_local)).norm(), 1e-9);
    EXPECT_LT((ExpMap(local.rotations.col(0)) - ExpMap(moved_local.rotations.col(0))).norm(), 1e-9);
  }
}

TEST(GroundFrame, WorldAndLocalAreInverse) {
  const Skeleton& smpl = Skeleton::Smpl24();
  std::mt19937 generator(3);
  const GroundFrame frame = GroundFrame::Of(fixtures::RandomPose(smpl, generator));
  const Pose pose = fixtures::RandomPose(smpl, generator);
  const Pose back = frame.ToWorld(frame.ToLocal(pose));
  EXPECT_LT((JointPositions(smpl, back) - JointPositions(smpl, pose)).norm(), 1e-9);
}

TEST(GroundFrame, ItsOwnPoseStandsAtTheOriginAndFacesZ) {
  const Skeleton& smpl = Skeleton::Smpl24();
  Pose pose = RestPose(smpl);
  pose.root_position += Eigen::Vector3d(3, 0.2, -4);
  pose.rotations.col(0) = Eigen::Vector3d(0, 2.2, 0);
  const Pose local = GroundFrame::Of(pose).ToLocal(pose);
  EXPECT_LT((local.root_position - Eigen::Vector3d(0, smpl.pelvis_height + 0.2, 0)).norm(), 1e-12);
  EXPECT_LT(local.rotations.norm(), 1e-12);
}

TEST(Mirror, IsAnInvolution) {
  const Skeleton& smpl = Skeleton::Smpl24();
  std::mt19937 generator(4);
  const Pose pose = fixtures::RandomPose(smpl, generator);
  const Pose twice = Mirror(smpl, Mirror(smpl, pose));
  EXPECT_EQ(twice.root_position, pose.root_position);
  EXPECT_EQ(twice.rotations, pose.rotations);
}

TEST(Mirror, CommutesWithForwardKinematics) {
  const Skeleton skeleton = fixtures::SymmetricSmpl();
  const std::vector<int> pairs = MirrorPairs(skeleton);
  std::mt19937 generator(5);
  const Pose pose = fixtures::RandomPose(skeleton, generator);
  const Eigen::Matrix3Xd positions = JointPositions(skeleton, pose);
  const Eigen::Matrix3Xd mirrored = JointPositions(skeleton, Mirror(skeleton, pose));
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const Eigen::Vector3d expected =
        positions.col(pairs[joint]).cwiseProduct(Eigen::Vector3d(-1, 1, 1));
    EXPECT_LT((mirrored.col(joint) - expected).norm(), 1e-12) << skeleton.joint_names[joint];
  }
  EXPECT_NE(pairs[skeleton.left_hip], skeleton.left_hip);
}

TEST(Mirror, RefusesASideWithoutCounterpart) {
  Skeleton skeleton = Chain();
  skeleton.joint_names[2] = "left_hand";
  EXPECT_THROW(MirrorPairs(skeleton), Error);
}

}  // namespace choreo::kinematics_test
