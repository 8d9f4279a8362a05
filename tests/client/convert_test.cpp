#include "client/convert.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace choreo::client::convert_test {

v1::Frames TwoFrames(int joints) {
  v1::Frames frames;
  frames.set_first_frame(7);
  frames.set_count(2);
  for (int i = 0; i < 6; ++i) frames.add_root_positions(static_cast<float>(i));
  for (int i = 0; i < 2 * 3 * joints; ++i) frames.add_rotations(static_cast<float>(100 + i));
  for (int i = 0; i < 8; ++i) frames.add_contacts(static_cast<float>(i));
  return frames;
}

TEST(ClientConvertTest, UnpacksFrames) {
  const FrameBlock block = FromProto(TwoFrames(3), 3);
  EXPECT_EQ(block.first_frame, 7);
  ASSERT_EQ(block.poses.size(), 2U);
  EXPECT_EQ(block.poses[1].root_position, Eigen::Vector3d(3, 4, 5));
  EXPECT_EQ(block.poses[1].rotations.col(2), Eigen::Vector3d(115, 116, 117));
  EXPECT_EQ(block.contacts[1][3], 7);
}

TEST(ClientConvertTest, RefusesFramesOfTheWrongLength) {
  ExpectError(ErrorCode::kInternal, "broke the protocol", [] { FromProto(TwoFrames(3), 4); });
  v1::Frames none = TwoFrames(3);
  none.set_count(0);
  ExpectError(ErrorCode::kInternal, "broke the protocol", [&] { FromProto(none, 3); });
  // Three numbers for each frame are two more than 2^32.
  v1::Frames huge;
  huge.set_count(1431655766);
  huge.mutable_root_positions()->Resize(2, 0);
  huge.mutable_rotations()->Resize(6, 0);
  ExpectError(ErrorCode::kInternal, "broke the protocol", [&] { FromProto(huge, 3); });
}

TEST(ClientConvertTest, IgnoresUnknownEvents) { EXPECT_FALSE(FromProto(v1::Event()).has_value()); }

TEST(ClientConvertTest, ModelsOfOldServersTakeTheServersLimit) {
  v1::GetServerInfoResponse response;
  response.mutable_limits()->set_max_transition_frames(1800);
  v1::ModelInfo* model = response.add_models();
  model->set_max_transition_frames(150);
  const Skeleton& skeleton = Skeleton::Smpl24();
  for (const std::string& name : skeleton.joint_names)
    model->mutable_skeleton()->add_joint_names(name);
  for (const int parent : skeleton.parents) model->mutable_skeleton()->add_parents(parent);
  for (const double value : skeleton.offsets.reshaped()) {
    model->mutable_skeleton()->add_offsets(static_cast<float>(value));
  }
  for (const int joint : skeleton.feet) model->mutable_skeleton()->add_feet(joint);
  model->mutable_skeleton()->set_pelvis_height(skeleton.pelvis_height);
  *response.add_models() = *model;
  response.mutable_models(1)->clear_max_transition_frames();
  const ServerDescription server = FromProto(response);
  EXPECT_EQ(server.models[0].max_transition_frames, 150);
  EXPECT_EQ(server.models[1].max_transition_frames, 1800);
}

TEST(ClientConvertTest, KeyFollowsItsMask) {
  KeyPose key;
  key.id = "a";
  key.frame = 12;
  key.pose.rotations = Eigen::Matrix3Xd::Random(3, 4);
  key.mask.root_position = false;
  key.mask.joints = {false, true, false, true};
  const v1::Keyframe proto = ToProto(key);
  EXPECT_EQ(proto.frame(), 12);
  EXPECT_FALSE(proto.pose().has_root_position());
  EXPECT_EQ(std::vector<int>(proto.mask().joints().begin(), proto.mask().joints().end()),
            (std::vector<int>{1, 3}));
  ASSERT_EQ(proto.pose().rotations_size(), 12);
  EXPECT_EQ(proto.pose().rotations(4), static_cast<float>(key.pose.rotations(1, 1)));
}

TEST(ClientConvertTest, RefusesInvalidContinuations) {
  DanceConfig config;
  config.continuation =
      Continuation{.frame = 3, .audio_from_sample = 0, .fingerprint = "", .bytes = "\xff\xff"};
  ExpectError(ErrorCode::kInvalidArgument, "continuation", [&] { ToProto(config); });
}

}  // namespace choreo::client::convert_test
