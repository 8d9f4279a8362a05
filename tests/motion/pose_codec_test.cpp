#include "model/motion/pose/pose_codec.h"

#include <gtest/gtest.h>

#include <numbers>

#include "model/core/error.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/velocity.h"
#include "model/motion/resample.h"
#include "model/motion/rotation.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo::pose_codec_test {

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

TEST(PoseCodec, HasThePapersLayout) {
  const PoseCodec codec(Smpl());
  EXPECT_EQ(codec.width(), 82);
  EXPECT_EQ(codec.velocity_at(), 75);
  EXPECT_EQ(codec.contacts_at(), 78);
}

TEST(PoseCodec, IsThePapersVector) {
  const PoseCodec codec(Smpl());
  const Motion motion = fixtures::SmoothMotion(Smpl(), 1, 300);
  const Contacts contacts = {1, 0, 0.25F, 1};
  for (size_t frame = 1; frame < motion.frames.size(); frame += 23) {
    const Pose& pose = motion.frames[frame];
    const Pose& previous = motion.frames[frame - 1];
    const Eigen::VectorXf x = codec.Encode(pose, previous, contacts, 30);
    EXPECT_LT((x.head<3>().cast<double>() - pose.root_position).norm(), 1e-6);
    EXPECT_LT(
        (Eigen::Map<const Eigen::Matrix3Xf>(x.data() + 3, 3, 24).cast<double>() - pose.rotations)
            .norm(),
        1e-5);
    const RootVelocity v = RootVelocityBetween(previous, pose, 30);
    EXPECT_NEAR(x[75], v.forward, 1e-6);
    EXPECT_NEAR(x[76], v.sideways, 1e-6);
    EXPECT_NEAR(x[77], v.yaw, 1e-6);
    const PoseCodec::Decoded decoded = codec.Decode(x);
    EXPECT_EQ(decoded.contacts, contacts);
    EXPECT_LT((JointPositions(Smpl(), decoded.pose) - JointPositions(Smpl(), pose)).norm(), 1e-5);
  }
}

TEST(PoseCodec, BranchFollowsThePreviousFrame) {
  const PoseCodec codec(Smpl());
  Pose previous = RestPose(Smpl());
  previous.rotations.col(0) = Eigen::Vector3d(0, 9.4, 0);
  Pose pose = previous;
  pose.rotations.col(0) = LogMap(ExpMap({0, 9.5, 0}));
  const Eigen::VectorXf x = codec.Encode(pose, previous, {}, 30);
  EXPECT_NEAR(x[4], 9.5, 1e-5);
}

TEST(PoseCodec, RefusesOtherShapes) {
  const PoseCodec codec(Smpl());
  const Pose rest = RestPose(Smpl());
  Pose short_pose = rest;
  short_pose.rotations.resize(3, 23);
  short_pose.rotations.setZero();
  EXPECT_THROW(codec.Encode(short_pose, rest, {}, 30), Error);
  EXPECT_THROW(codec.Decode(Eigen::VectorXf::Zero(81)), Error);
}

}  // namespace choreo::pose_codec_test
