#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "client/cli/key_file.h"
#include "client/cli/pose_library.h"
#include "model/core/npy.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"

namespace choreo {
namespace {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

TEST_F(CommandTest, DancesThroughTheLibraryAndWritesBesideTheSong) {
  WriteClicks(folder_ / "song.wav", 10);
  const Outcome outcome =
      Choreo("dance " + At("song.wav") + Server() + "--seed 3 --report " + At("report.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("song.npz"));
  const Motion motion = ReadMotion(folder_ / "song.npz", Body());
  EXPECT_EQ(motion.fps, 30);
  EXPECT_EQ(motion.frames.size(), 300U);

  const nlohmann::json report = ReadJson(folder_ / "report.json");
  std::vector<std::string> members;
  for (const auto& [member, value] : report.items()) members.push_back(member);
  EXPECT_THAT(members,
              testing::UnorderedElementsAre("frames", "fps", "seed", "fingerprint", "keyframes",
                                            "log_likelihood", "beat_hit_rate", "skate_ratio",
                                            "first_frame_latency_s", "real_time_factor"));
  EXPECT_EQ(report["frames"], 300);
  EXPECT_EQ(report["seed"], 3);
  EXPECT_EQ(report["fingerprint"], "fake-1");
  ASSERT_GE(report["keyframes"].size(), 4U);
  for (const auto& key : report["keyframes"]) {
    EXPECT_LE(key["final_error_m"].get<double>(), 0.001);
    EXPECT_LE(key["final_error_deg"].get<double>(), 0.1);
    EXPECT_TRUE(key.contains("raw_error_m"));
    // What the report says is in the file.
    const std::string id = key["id"];
    const Pose& pose = cli::FindLibraryPose(id.substr(id.find('-') + 1)).pose;
    const Pose& danced = motion.frames[key["frame"].get<size_t>()];
    EXPECT_LT((pose.rotations.rightCols(23) - danced.rotations.rightCols(23)).cwiseAbs().maxCoeff(),
              0.01)
        << id;
  }
}

TEST_F(CommandTest, DancesThroughKeyFilesAndMotions) {
  WriteClicks(folder_ / "song.wav", 6);
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 3.5, "root_position": [0.5, 1.0, 0.5], "rotations": )"
      << nlohmann::json(std::vector(24, std::vector{0.0, 0.1, 0.0})) << "}]}";
  Motion walk{.fps = 30, .frames = std::vector<Pose>(60, RestPose(Body()))};
  walk.frames[45].rotations(2, 16) = -1;
  WriteMotion(folder_ / "walk.bvh", Body(), walk);
  const Outcome outcome =
      Choreo("dance " + At("song.wav") + Server() + "--seconds 5 -k " + At("keys.json") + " -k " +
             At("walk.bvh@1.5") + " --fps 60 -o " + At("dance.bvh"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion motion = ReadMotion(folder_ / "dance.bvh", Body());
  EXPECT_NEAR(motion.fps, 60, 1e-3);
  ASSERT_EQ(motion.frames.size(), 299U);  // up to the last frame of 5 s at 30 fps
  EXPECT_LT((motion.frames[210].root_position - Eigen::Vector3d(0.5, 1.0, 0.5)).norm(), 0.001);
  EXPECT_NEAR(motion.frames[90].rotations(2, 16), -1, 0.002);
}

TEST_F(CommandTest, MovesFromPoseToPose) {
  const Outcome outcome =
      Choreo("transition --from contrapposto --to kick --frames 40 --candidates 2 --out " +
             At("t.npz") + Server());
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  for (const char* name : {"t.npz", "t.2.npz"}) {
    const Motion motion = ReadMotion(folder_ / name, Body());
    ASSERT_EQ(motion.frames.size(), 40U);
    EXPECT_LE(
        ComparePoses(Body(), motion.frames.back(), cli::FindLibraryPose("kick").pose).position_m,
        0.001);
  }
}

TEST_F(CommandTest, AnalyzesASong) {
  WriteClicks(folder_ / "song.wav", 8);
  const Outcome outcome = Choreo("analyze " + At("song.wav") + " --json --features " + At("f.npy"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const nlohmann::json heard = nlohmann::json::parse(outcome.said);
  EXPECT_NEAR(heard["duration_s"], 8, 1e-3);
  EXPECT_EQ(heard["sample_rate"], 22050);
  EXPECT_NEAR(heard["tempo_bpm"], 120, 5);
  ASSERT_GT(heard["beats"].size(), 8U);
  for (const double beat : heard["beats"]) EXPECT_NEAR(std::remainder(beat, 0.5), 0, 0.07);
  EXPECT_EQ(ReadNpy(folder_ / "f.npy").shape, (std::vector<int64_t>{241, 40}));
}

TEST_F(CommandTest, ConvertsAndDraws) {
  const Motion motion{.fps = 30,
                      .frames = std::vector<Pose>(31, cli::FindLibraryPose("groove").pose)};
  WriteMotion(folder_ / "a.bvh", Body(), motion);
  ASSERT_EQ(Choreo("convert " + At("a.bvh") + " " + At("b.npz") + " --fps 60").code, 0);
  const Motion converted = ReadMotion(folder_ / "b.npz", Body());
  EXPECT_EQ(converted.fps, 60);
  ASSERT_EQ(converted.frames.size(), 61U);
  EXPECT_LT(ComparePoses(Body(), converted.frames[30], motion.frames[0]).position_m, 1e-4);

  ASSERT_EQ(Choreo("render " + At("b.npz") + " --frames 4 --columns 2 --out " + At("s.png")).code,
            0);
  std::ifstream png(folder_ / "s.png", std::ios::binary);
  std::string magic(4, '\0');
  png.read(magic.data(), 4);
  EXPECT_EQ(magic, "\x89PNG");
}

TEST_F(CommandTest, TellsAboutTheServerAndItsPoses) {
  const nlohmann::json info = nlohmann::json::parse(Choreo("info --json" + Server()).said);
  EXPECT_EQ(info["models"][0]["name"], "fake");
  EXPECT_EQ(info["models"][0]["skeleton"]["joints"].size(), 24U);
  EXPECT_THAT(Choreo("info" + Server()).said, HasSubstr("fingerprint fake-1"));
  EXPECT_THAT(Choreo("info --poses").said, HasSubstr("arabesque"));
}

TEST_F(CommandTest, FailsWithOneLineAndCodeOne) {
  WriteClicks(folder_ / "song.wav", 4);
  std::ofstream(folder_ / "bad.json") << R"({"keyframes": [{"time": 1}]})";
  std::ofstream(folder_ / "noise.wav") << "no music";
  const auto expect_failure = [](const std::string& arguments, const std::string& part) {
    const Outcome outcome = Choreo(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_THAT(outcome.said, testing::StartsWith("choreo: "));
    EXPECT_THAT(outcome.said, HasSubstr(part));
    EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 1) << outcome.said;
  };
  expect_failure("dance " + At("song.wav") + Server() + "-k " + At("bad.json"),
                 "keyframes[0].rotations: is missing");
  expect_failure("dance " + At("song.wav") + Server() + "--model swan", "\"swan\", but fake");
  expect_failure("dance " + At("song.wav") + Server() + "--out x.mp4",
                 "must be .npz, .bvh or .glb");
  expect_failure("dance " + At("song.wav") + Server() + "--out /absent/x.npz", "no folder /absent");
  expect_failure("dance " + At("song.wav") + Server() + "--temperature 9", "temperature");
  expect_failure("dance " + At("noise.wav") + Server(), "noise.wav");
  expect_failure("transition --from swan --to kick --out " + At("t.npz") + Server(),
                 "swan: is no pose of the library");
  expect_failure("convert " + At("song.wav") + " " + At("b.npz"), "song.wav");
  expect_failure("info --deadline 0.3 --server 127.0.0.1:1", "127.0.0.1:1");
}

TEST_F(CommandTest, ExplainsItself) {
  EXPECT_EQ(Choreo("").code, 2);
  EXPECT_EQ(Choreo("swim").code, 2);
  EXPECT_EQ(Choreo("dance").code, 2);
  EXPECT_EQ(Choreo("dance /absent.ogg").code, 2);
  for (const char* command :
       {"", "dance", "transition", "edit", "analyze", "info", "health", "convert", "render"}) {
    const Outcome outcome = Choreo(std::string(command) + " --help");
    EXPECT_EQ(outcome.code, 0) << command;
    EXPECT_THAT(outcome.said, HasSubstr("Usage:")) << command;
  }
  EXPECT_EQ(Choreo("--version").code, 0);
}

}  // namespace
}  // namespace choreo
