#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>

#include "client/authoring/keys/choreography.h"
#include "client/authoring/keys/pose_library.h"
#include "client/choreo_client.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/papers/training/paper_options.h"
#include "model/samplers/samplers.h"
#include "model/training/clips/prepared_clip.h"
#include "model/training/prepare/prepare.h"
#include "server/server.h"
#include "tests/client/test_music.h"
#include "tests/support/expect_error.h"
#include "tests/support/native_tang2018.h"
#include "tests/support/tang2018_files.h"
#include "tests/support/temporary_folder.h"

/// Paper F's Figure 12, by our own programs on recordings of our own making: prepare tang2018
/// natively, train a few steps, serve the checkpoint in this process, dance.
namespace choreo::native_skeleton_test {

using testing_support::Native;

// At the recordings' 25 fps, in centimetres.
void Record(const std::filesystem::path& path, uint32_t seed) {
  const Motion motion = fixtures::SmoothMotion(Native().skeleton, seed, 110, 25);
  PositionClip clip = testing_support::RecordNative(motion);
  for (Eigen::Matrix3Xd& frame : clip.frames) frame *= 100;
  WriteTang2018Npy(path, clip);
}

class NativeSkeletonTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path recordings = folder_ / "recordings";
    std::filesystem::create_directories(recordings);
    for (const char* name : {"DANCE_C_1", "DANCE_C_2", "DANCE_C_3"}) {
      Record(recordings / (std::string(name) + ".npy"), static_cast<uint32_t>(name[8]));
      WriteClicks(recordings / (std::string(name) + ".wav"), 5);
    }
    PrepareOptions prepare;
    prepare.layout = "tang2018";
    prepare.native_skeleton = true;
    prepare.input = recordings;
    prepare.output = folder_ / "data";
    ASSERT_EQ(Prepare(prepare), 3);
    skeleton_ = ReadPreparedClip(prepare.output / "DANCE_C_1.clip").skeleton;
  }

  // Trains a model for a few steps, serves it, and connects to it.
  void Serve(const std::string& preset) {
    const std::filesystem::path data = folder_ / "data";
    std::ofstream(data / "splits.json") << R"({"tang2018": {"validation": ["DANCE_C_3"]}})";
    PaperOptions train;
    train.preset = preset;
    train.data = {data};
    train.splits = data / "splits.json";
    train.run = folder_ / "run";
    train.steps = 2;
    train.batch = 4;
    train.longest = 10;
    train.report_every = 100;
    TrainFlow(train);
    std::vector<Server::Samplers> models(1);
    models[0].push_back(MakeSampler(train.run / "checkpoint.safetensors", {}));
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    server_ = std::make_unique<Server>(config, std::move(models));
    client_ = std::make_unique<client::Client>(client::Options{
        .addresses = {"127.0.0.1:" + std::to_string(server_->port())}, .retry_s = 0});
  }

  client::KeyPose Key(int64_t frame) const {
    client::KeyPose key{.id = "bow", .frame = frame, .pose = RestPose(skeleton_)};
    key.pose.root_position.x() = 0.2;
    key.pose.rotations(0, skeleton_.Find("chest")) = 0.5;
    key.pose.rotations(1, skeleton_.left_elbow) = -0.9;
    return key;
  }

  void ExpectToDanceThroughAKey() const {
    const client::DanceResult dance =
        client_->Dance({.seed = 3, .frames = 90}, {Key(44)}, ClicksAudio(3));
    const Skeleton& skeleton = dance.header.skeleton;
    EXPECT_EQ(skeleton.name, "tang2018");
    EXPECT_EQ(skeleton.joint_names, skeleton_.joint_names);
    EXPECT_EQ(skeleton.joint_names.size(), 23U);
    EXPECT_EQ(skeleton.feet, skeleton_.feet);
    EXPECT_TRUE(SameBones(skeleton, skeleton_));
    ASSERT_EQ(dance.motion.frames.size(), 90U);
    ASSERT_EQ(dance.report.keys.size(), 1U);
    EXPECT_LE(dance.report.keys[0].final_error_m, 0.001);
    const PoseError miss = ComparePoses(skeleton_, dance.motion.frames[44], Key(44).pose);
    EXPECT_LE(miss.position_m, 0.001);
    EXPECT_LE(miss.angle_deg, 0.1);
  }

  void ExpectOtherJointCountsRefusedNamingBoth() const {
    for (const int joints : {22, 24}) {
      client::KeyPose key = Key(30);
      key.pose.rotations.setZero(3, joints);
      ExpectError(ErrorCode::kInvalidArgument,
                  std::to_string(joints) + " joints; the model has 23 joints",
                  [&] { client_->Dance({.frames = 60}, {key}, {}); });
      ExpectError(ErrorCode::kInvalidArgument,
                  std::to_string(joints) + " joints; the model has 23 joints",
                  [&] { client_->Dance({.history = {key.pose}, .frames = 60}, {}, {}); });
    }
  }

  // Those of SMPL's joints, for a model that has others.
  void ExpectToDanceThroughTheKeyPosesThatShip() const {
    const auto keys = authoring::ComposeKeys({.seconds = 4, .beats = {}, .seed = 1},
                                             authoring::PosesToDance(skeleton_));
    const client::DanceResult dance =
        client_->Dance({.seed = 1, .frames = 120}, keys, ClicksAudio(4));
    ASSERT_EQ(dance.report.keys.size(), keys.size());
    for (const client::KeyReached& key : dance.report.keys) EXPECT_LE(key.final_error_m, 0.001);
  }

  void ExpectDancesToGoThroughFiles() const {
    const client::DanceResult dance = client_->Dance({.seed = 2, .frames = 40}, {Key(20)}, {});
    for (const char* name : {"dance.npz", "dance.bvh", "dance.glb"}) {
      SCOPED_TRACE(name);
      WriteMotion(folder_ / name, dance.header.skeleton, dance.motion, &dance.contacts);
      const Motion back = ReadMotion(folder_ / name, dance.header.skeleton);
      ASSERT_EQ(back.frames.size(), 40U);
      for (size_t frame = 0; frame < 40; frame += 3) {
        EXPECT_LT(
            ComparePoses(skeleton_, back.frames[frame], dance.motion.frames[frame]).position_m,
            1e-4);
      }
      EXPECT_EQ(ReadMotion(folder_ / name).skeleton.joints(), 23);
    }
  }

  TemporaryFolder folder_;
  Skeleton skeleton_;
  std::unique_ptr<Server> server_;
  std::unique_ptr<client::Client> client_;
};

TEST_F(NativeSkeletonTest, FromRecordingsToADanceOn23Joints) {
  Serve("ablation");
  EXPECT_EQ(client_->GetServerInfo().models[0].skeleton.joint_names, skeleton_.joint_names);
  ExpectToDanceThroughAKey();
  ExpectOtherJointCountsRefusedNamingBoth();
  ExpectToDanceThroughTheKeyPosesThatShip();
  ExpectDancesToGoThroughFiles();
}

TEST(PoseLibrary, RequestsKeyframesIfItCannotBeRetargeted) {
  Skeleton stick = Native().skeleton;
  stick.right_elbow = -1;
  ExpectError(ErrorCode::kInvalidArgument, "keyframes: key poses are needed",
              [&] { authoring::PosesToDance(stick); });
}

}  // namespace choreo::native_skeleton_test
