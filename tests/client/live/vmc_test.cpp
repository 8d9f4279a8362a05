#include "client/live/vmc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <regex>

#include "client/authoring/keys/pose_library.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/live/osc_receiver.h"
#include "tests/client/test_music.h"
#include "tests/support/eventually.h"
#include "tests/support/expect_error.h"

namespace choreo::vmc_test {

struct Placed {
  Eigen::Vector3f position;
  Eigen::Quaternionf rotation;
};

/// Root and bones of a frame by name.
std::map<std::string, Placed> Bones(const std::vector<OscMessage>& bundle) {
  std::map<std::string, Placed> bones;
  for (const OscMessage& message : bundle) {
    if (message.types != ",sfffffff") continue;
    const std::vector<float>& f = message.floats;
    bones[message.strings[0]] = {{f[0], f[1], f[2]}, {f[6], f[3], f[4], f[5]}};
  }
  return bones;
}

/// Where the last of a chain of bones is: quaternions turn alike in left-handed spaces.
Eigen::Vector3f Reach(const std::map<std::string, Placed>& bones,
                      const std::vector<std::string>& chain) {
  Placed at = bones.at("root");
  for (const std::string& name : chain) {
    const Placed& bone = bones.at(name);
    at.position += at.rotation * bone.position;
    at.rotation = at.rotation * bone.rotation;
  }
  return at.position;
}

TEST(VmcTest, FrameIsABundleOfTheMirroredBody) {
  const Skeleton& body = Skeleton::Smpl24();
  Pose pose = authoring::FindLibraryPose("kick").pose;
  pose.root_position += Eigen::Vector3d(0.7, 0.1, -1.3);
  pose.rotations.col(0) += Eigen::Vector3d(0.2, 0.9, -0.1);
  OscReceiver receiver;
  live::VmcSender(receiver.address(), body).Send(pose, 2.5);
  const auto bundles = receiver.Stop();
  ASSERT_EQ(bundles.size(), 2U);
  ASSERT_EQ(bundles[0].size(), 1U);
  EXPECT_EQ(bundles[0][0].path, "/VMC/Ext/OK");
  EXPECT_EQ(bundles[0][0].ints, std::vector<int32_t>{0});

  const std::vector<OscMessage>& frame = bundles[1];
  ASSERT_EQ(frame.size(), 3U + 22U);
  EXPECT_EQ(frame[0].path, "/VMC/Ext/OK");
  EXPECT_EQ(frame[0].ints, std::vector<int32_t>{1});
  EXPECT_EQ(frame[1].path, "/VMC/Ext/T");
  EXPECT_EQ(frame[1].floats, std::vector<float>{2.5});
  EXPECT_EQ(frame[2].path, "/VMC/Ext/Root/Pos");
  for (size_t i = 3; i < frame.size(); ++i) EXPECT_EQ(frame[i].path, "/VMC/Ext/Bone/Pos");
  const auto bones = Bones(frame);
  ASSERT_EQ(bones.size(), 23U);
  EXPECT_EQ(bones.at("root").position.y(), 0);

  const Eigen::Matrix3Xd wanted = JointPositions(body, pose);
  const std::vector<std::string> trunk = {"Hips", "Spine", "Chest", "UpperChest"};
  const auto expect = [&](const char* joint, const std::vector<std::string>& limb, bool whole) {
    std::vector<std::string> chain = whole ? trunk : std::vector<std::string>{"Hips"};
    chain.insert(chain.end(), limb.begin(), limb.end());
    const Eigen::Vector3d at = wanted.col(body.Find(joint));
    EXPECT_LT((Reach(bones, chain) - Eigen::Vector3d(-at.x(), at.y(), at.z()).cast<float>()).norm(),
              1e-5)
        << joint;
  };
  expect("head", {"Neck", "Head"}, true);
  expect("left_wrist", {"LeftShoulder", "LeftUpperArm", "LeftLowerArm", "LeftHand"}, true);
  expect("right_wrist", {"RightShoulder", "RightUpperArm", "RightLowerArm", "RightHand"}, true);
  expect("left_foot", {"LeftUpperLeg", "LeftLowerLeg", "LeftFoot", "LeftToes"}, false);
  expect("right_foot", {"RightUpperLeg", "RightLowerLeg", "RightFoot", "RightToes"}, false);
}

TEST(VmcTest, NamesAnInvalidAddress) {
  for (const char* address :
       {"nowhere", "127.0.0.1:", ":39539", "127.0.0.1:port", "127.0.0.1:99999", "127.0.0.1:0"}) {
    ExpectError(ErrorCode::kInvalidArgument, "--vmc",
                [&] { live::VmcSender(address, Skeleton::Smpl24()); });
  }
}

TEST_F(CommandTest, ADanceIsStreamedAsVmcWhileItIsMade) {
  WriteClicks(folder_ / "song.wav", 1);
  OscReceiver receiver;
  const Outcome outcome = Choreo("dance " + At("song.wav") + Server() + "-k none -o " +
                                 At("d.npz") + " --vmc " + receiver.address());
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion motion = ReadMotion(folder_ / "d.npz", Skeleton::Smpl24());
  const auto bundles = receiver.Stop();
  ASSERT_EQ(bundles.size(), 1 + motion.frames.size());
  for (size_t i = 0; i < motion.frames.size(); ++i) {
    EXPECT_NEAR(bundles[i + 1][1].floats[0], static_cast<double>(i) / 30, 1e-5);
    EXPECT_NEAR(Bones(bundles[i + 1]).at("Hips").position.y(), motion.frames[i].root_position.y(),
                1e-4);
  }
}

/// Whether somebody is connected to this port of this machine.
bool IsConnected(int port) {
  std::ifstream table("/proc/net/tcp");
  char hexadecimal[8];
  std::snprintf(hexadecimal, sizeof hexadecimal, "%04X", port);
  const std::regex established(std::string(":") + hexadecimal + " [0-9A-F]+:[0-9A-F]+ 01");
  for (std::string line; std::getline(table, line);)
    if (std::regex_search(line, established)) return true;
  return false;
}

// gRPC hardly polls meanwhile: pings got no answers, and new connections no handshakes.
TEST_F(CommandTest, NoServerIsHeldWhileADanceIsShown) {
  OscReceiver receiver;
  auto shown = std::async(std::launch::async, [&] {
    return Choreo("dance --seconds 4 -k none" + Server() + "-o " + At("d.npz") + " --vmc " +
                  receiver.address());
  });
  ASSERT_TRUE(Eventually([&] { return std::filesystem::exists(folder_ / "d.npz"); }));
  ASSERT_TRUE(Eventually([&] { return !IsConnected(server_.port()); }));
  const size_t by_then = receiver.count();
  EXPECT_EQ(shown.get().code, 0);
  EXPECT_LT(by_then, receiver.Stop().size());
}

}  // namespace choreo::vmc_test
