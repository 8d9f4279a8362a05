#include "proto/wire/poses.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "model/core/error.h"
#include "model/motion/rotation.h"
#include "proto/wire/convert.h"

namespace choreo::poses_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

Pose SomePose() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1.5, 1.5);
  Pose pose;
  pose.root_position = {0.25, 0.875, -1.5};
  pose.rotations = Eigen::Matrix3Xd::NullaryExpr(3, Body().joints(), [&] { return value(random); });
  return pose;
}

class ReadPoseTest : public testing::TestWithParam<v1::RotationEncoding> {};

TEST_P(ReadPoseTest, RoundTrips) {
  const Pose pose = SomePose();
  const Contacts contacts = {0.25F, 0.5F, 0.75F, 1.0F};
  const v1::Frames frames = wire::ToProto(17, {&pose, 1}, {&contacts, 1}, GetParam());
  EXPECT_EQ(frames.first_frame(), 17);
  EXPECT_EQ(frames.count(), 1);
  EXPECT_EQ(frames.contacts(2), 0.75F);

  v1::Pose message;
  message.set_encoding(GetParam());
  *message.mutable_rotations() = frames.rotations();
  message.mutable_root_position()->set_x(frames.root_positions(0));
  message.mutable_root_position()->set_y(frames.root_positions(1));
  message.mutable_root_position()->set_z(frames.root_positions(2));
  const Pose back = wire::ToPose(message, Body(), "pose");
  EXPECT_TRUE(back.root_position.isApprox(pose.root_position, 1e-6));
  for (int joint = 0; joint < Body().joints(); ++joint) {
    EXPECT_LT(RotationDifference(pose.rotations.col(joint), back.rotations.col(joint)).norm(), 1e-5)
        << joint;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReadPoseTest,
                         testing::Values(v1::ROTATION_ENCODING_UNSPECIFIED,
                                         v1::ROTATION_ENCODING_AXIS_ANGLE,
                                         v1::ROTATION_ENCODING_QUATERNION,
                                         v1::ROTATION_ENCODING_MATRIX));

// A turn through pi and on must not make quaternions jump.
TEST(ReadPose, QuaternionsAreContinuous) {
  Eigen::Vector4d previous;
  for (int step = 0; step <= 400; ++step) {
    Pose pose;
    pose.rotations = Eigen::Matrix3Xd::Zero(3, 1);
    pose.rotations(1, 0) = 0.02 * step;
    const Contacts contacts = {};
    const v1::Frames frames =
        wire::ToProto(0, {&pose, 1}, {&contacts, 1}, v1::ROTATION_ENCODING_QUATERNION);
    const Eigen::Vector4d now(frames.rotations(0), frames.rotations(1), frames.rotations(2),
                              frames.rotations(3));
    if (step > 0) {
      EXPECT_LT((now - previous).norm(), 0.02) << step;
    }
    previous = now;
  }
}

void ExpectRefused(const v1::Pose& pose, const std::string& field, const std::string& says) {
  try {
    wire::ToPose(pose, Body(), "keyframes[3]");
    FAIL() << "taken: " << field;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
    EXPECT_EQ(error.field(), field);
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(ReadPose, WrongRotationsAreNamed) {
  v1::Pose pose;
  pose.mutable_root_position();
  pose.set_encoding(v1::ROTATION_ENCODING_QUATERNION);
  for (int joint = 0; joint < 24; ++joint) {
    for (const float value : {0.0F, 0.0F, 0.0F, joint == 16 ? 1.1F : 1.0F}) {
      pose.add_rotations(value);
    }
  }
  ExpectRefused(pose, "keyframes[3].rotations[16]", "1.1");
  pose.set_encoding(v1::ROTATION_ENCODING_AXIS_ANGLE);
  ExpectRefused(pose, "keyframes[3].rotations", "32 joints; the model has 24");
  pose.add_rotations(0);
  ExpectRefused(pose, "keyframes[3].rotations", "97 numbers are no multiple of 3");
  pose.set_encoding(static_cast<v1::RotationEncoding>(9));
  ExpectRefused(pose, "keyframes[3].encoding", "9");

  v1::Pose matrices;
  matrices.mutable_root_position();
  matrices.set_encoding(v1::ROTATION_ENCODING_MATRIX);
  for (int joint = 0; joint < 24; ++joint) {
    for (int i = 0; i < 9; ++i) {
      const float diagonal = joint == 5 ? -1.0F : 1.0F;  // a reflection
      matrices.add_rotations(i % 4 == 0 ? diagonal : 0.0F);
    }
  }
  ExpectRefused(matrices, "keyframes[3].rotations[5]", "-1");
}

}  // namespace choreo::poses_test
