#include "model/motion/pose_codec.h"

#include <gtest/gtest.h>

#include <numbers>

#include "model/core/error.h"
#include "model/motion/kinematics.h"
#include "model/motion/resample.h"
#include "model/motion/rotation.h"
#include "model/motion/velocity.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo {
namespace {

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

TEST(PoseCodec, HasThePapersLayout) {
  const PoseCodec codec(Smpl());
  EXPECT_EQ(codec.width(), 82);
  EXPECT_EQ(codec.velocity_at(), 75);
  EXPECT_EQ(codec.contacts_at(), 78);
}

TEST(PoseCodec, WithoutReferenceItIsThePapersVector) {
  const PoseCodec codec(Smpl());
  const Motion motion = fixtures::SmoothMotion(Smpl(), 1, 300);
  const Contacts contacts = {1, 0, 0.25F, 1};
  for (size_t frame = 1; frame < motion.frames.size(); frame += 23) {
    const Pose& pose = motion.frames[frame];
    const Pose& previous = motion.frames[frame - 1];
    const Eigen::VectorXf x = codec.Encode(pose, previous, nullptr, contacts, 30);
    EXPECT_LT((x.head<3>().cast<double>() - pose.root_position).norm(), 1e-6);
    EXPECT_LT(
        (Eigen::Map<const Eigen::Matrix3Xf>(x.data() + 3, 3, 24).cast<double>() - pose.rotations)
            .norm(),
        1e-5);
    const RootVelocity v = RootVelocityBetween(previous, pose, 30);
    EXPECT_NEAR(x[75], v.forward, 1e-6);
    EXPECT_NEAR(x[76], v.sideways, 1e-6);
    EXPECT_NEAR(x[77], v.yaw, 1e-6);
    const PoseCodec::Decoded decoded = codec.Decode(x, nullptr);
    EXPECT_EQ(decoded.contacts, contacts);
    EXPECT_LT((JointPositions(Smpl(), decoded.pose) - JointPositions(Smpl(), pose)).norm(), 1e-5);
  }
}

TEST(PoseCodec, WithoutReferenceTheBranchIsThatOfThePreviousFrame) {
  const PoseCodec codec(Smpl());
  Pose previous = RestPose(Smpl());
  previous.rotations.col(0) = Eigen::Vector3d(0, 9.4, 0);
  Pose pose = previous;
  pose.rotations.col(0) = LogMap(ExpMap({0, 9.5, 0}));
  const Eigen::VectorXf x = codec.Encode(pose, previous, nullptr, {}, 30);
  EXPECT_NEAR(x[4], 9.5, 1e-5);
}

TEST(PoseCodec, RoundTripsRelativeToAnyReference) {
  const PoseCodec codec(Smpl());
  const Motion motion = fixtures::SmoothMotion(Smpl(), 2, 200);
  std::mt19937 generator(1);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Pose reference = fixtures::RandomPose(Smpl(), generator);
    const Pose& pose = motion.frames[10 + repeat];
    const Eigen::VectorXf x =
        codec.Encode(pose, motion.frames[9 + repeat], &reference, {0, 1, 0, 1}, 30);
    const PoseCodec::Decoded decoded = codec.Decode(x, &reference);
    EXPECT_EQ(decoded.contacts, (Contacts{0, 1, 0, 1}));
    const PoseError error = ComparePoses(Smpl(), decoded.pose, pose);
    EXPECT_LT(error.position_m, 1e-5);
    EXPECT_LT(error.angle_deg, 1e-3);
    for (int joint = 0; joint < 24; ++joint) {
      EXPECT_LE(x.segment<3>(3 + 3 * joint).norm(), std::numbers::pi + 1e-5);
    }
  }
}

TEST(PoseCodec, APoseRelativeToItselfIsZero) {
  const PoseCodec codec(Smpl());
  const Pose pose = fixtures::SmoothMotion(Smpl(), 3, 5).frames[4];
  EXPECT_LT(codec.Encode(pose, pose, &pose, {}, 30).norm(), 1e-6);
}

TEST(PoseCodec, DecodedRotationsStayNearTheReferencesBranch) {
  const PoseCodec codec(Smpl());
  Pose reference = RestPose(Smpl());
  reference.rotations.col(0) = Eigen::Vector3d(0, 12.0, 0);
  Pose pose = reference;
  pose.rotations.col(0) = Eigen::Vector3d(0, 12.5, 0);
  const Eigen::VectorXf x = codec.Encode(pose, reference, &reference, {}, 30);
  EXPECT_NEAR(x[4], 0.5, 1e-6);
  EXPECT_NEAR(codec.Decode(x, &reference).pose.rotations(1, 0), 12.5, 1e-5);
}

TEST(PoseCodec, RefusesOtherShapes) {
  const PoseCodec codec(Smpl());
  const Pose rest = RestPose(Smpl());
  Pose short_pose = rest;
  short_pose.rotations.resize(3, 23);
  short_pose.rotations.setZero();
  EXPECT_THROW(codec.Encode(short_pose, rest, nullptr, {}, 30), Error);
  EXPECT_THROW(codec.Encode(rest, rest, &short_pose, {}, 30), Error);
  EXPECT_THROW(codec.Decode(Eigen::VectorXf::Zero(81), nullptr), Error);
}

}  // namespace
}  // namespace choreo
