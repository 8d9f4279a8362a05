#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "model/formats/motion_file.h"
#include "model/motion/controls/path_curve.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"
#include "tests/draw/decoded_png.h"
#include "tests/support/music_files.h"

namespace choreo::plot_command_test {

using testing::HasSubstr;

constexpr uint32_t kFirstLine = 0x0072b2, kSecondLine = 0xd55e00, kInk = 0x24292f;  // of plots

/// A folder with two motions, one slow and straight, one fast, aslant and rising with a swinging
/// arm, and a path.
class PlotCommandTest : public testing::Test {
 protected:
  PlotCommandTest() {
    for (const double speed : {0.01, 0.02}) {
      Motion motion;
      for (int frame = 0; frame < 60; ++frame) {
        Pose pose = RestPose(Skeleton::Smpl24());
        pose.root_position.z() = speed * frame;
        if (speed > 0.01) {
          pose.root_position += Eigen::Vector3d(0.004, 0.002, 0) * frame;
          pose.rotations(2, Skeleton::Smpl24().left_shoulder) = 0.02 * frame;
        }
        motion.frames.push_back(pose);
      }
      WriteMotion(folder_ / (speed == 0.01 ? "slow.npz" : "fast.npz"), Skeleton::Smpl24(), motion);
    }
    std::ofstream(folder_ / "path.json")
        << R"({"points": [{"time": 0, "x": 0, "z": 0}, {"time": 2, "x": 0.5, "z": 0.6}]})";
  }
  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  Outcome Plot(const std::string& arguments) const {
    return Choreo("plot " + arguments + " -o " + At("plot.png"));
  }
  int Drawn(uint32_t colour) const { return DecodedPng(folder_ / "plot.png").Count(colour); }

  TemporaryFolder folder_;
};

TEST_F(PlotCommandTest, DrawsPathsHeightsAndSpeeds) {
  for (const std::string of : {"path", "height", "trunk", "left_arm"}) {
    const Outcome outcome = Plot(of + " " + At("slow.npz") + " " + At("fast.npz"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    for (const uint32_t line : {kFirstLine, kSecondLine}) EXPECT_GT(Drawn(line), 100) << of;
  }
}

TEST_F(PlotCommandTest, DrawsRequestsBesideResults) {
  const std::string both = At("slow.npz") + " " + At("fast.npz");
  const auto ink = [&](const std::string& arguments) {
    const Outcome outcome = Plot(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return Drawn(kInk);
  };
  EXPECT_GT(ink("path " + both + " --path " + At("path.json")), ink("path " + both) + 100);
  std::ofstream(folder_ / "counts.json")
      << R"({"points": [{"time": "1c", "x": 0, "z": 0}, {"time": "5c", "x": 0.5, "z": 0.6}]})";
  WriteClicks(folder_ / "song.wav", 8);
  EXPECT_GT(ink("path " + both + " --path " + At("counts.json") + " --song " + At("song.wav")),
            ink("path " + both) + 100);
  EXPECT_GT(ink("trunk " + both + " --asked 0.5"), ink("trunk " + both) + 100);
  // One each has its motion's colour.
  EXPECT_LT(ink("trunk " + both + " --asked 0.5 --asked 0.6"), ink("trunk " + both) + 100);
}

// A dance on the curve hides what was asked for; straight legs between the points would cut
// corners.
TEST_F(PlotCommandTest, DrawsAPathAsTheCurveThatIsDanced) {
  const PathCurve curve({.frames = {0, 30, 60}, .points = {{0, 0}, {0.6, 0}, {0.6, 0.6}}});
  Motion motion;
  std::string points;
  for (int frame = 0; frame <= 60; ++frame) {
    Pose pose = RestPose(Skeleton::Smpl24());
    pose.root_position = curve.At(frame).position;
    motion.frames.push_back(pose);
    points += (points.empty() ? "" : ", ") + std::string("{\"time\": ") +
              std::to_string(frame / 30.0) + ", \"x\": " + std::to_string(pose.root_position.x()) +
              ", \"z\": " + std::to_string(pose.root_position.z()) + "}";
  }
  WriteMotion(folder_ / "curve.npz", Skeleton::Smpl24(), motion);
  std::ofstream(folder_ / "all.json") << R"({"points": [)" << points << "]}";
  std::ofstream(folder_ / "corner.json")
      << R"({"points": [{"time": 0, "x": 0, "z": 0}, {"time": 1, "x": 0.6, "z": 0},
                        {"time": 2, "x": 0.6, "z": 0.6}]})";
  const auto ink = [&](const std::string& path) {
    const std::string twice = At("curve.npz") + " " + At("curve.npz");
    const Outcome outcome = Plot("path " + twice + " --path " + At(path));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return Drawn(kInk);
  };
  EXPECT_NEAR(ink("corner.json"), ink("all.json"), 20);
}

// Paper F's Figure 4: the speed, its maxima in its colour, the song's beats in ink.
TEST_F(PlotCommandTest, DrawsBeatsOfTheBodyAndOfTheSong) {
  Motion motion;
  for (int frame = 0; frame < 180; ++frame) {
    Pose pose = RestPose(Skeleton::Smpl24());
    pose.root_position.z() = 0.2 * std::sin(frame * 0.21);
    motion.frames.push_back(pose);
  }
  WriteMotion(folder_ / "sway.npz", Skeleton::Smpl24(), motion);
  WriteClicks(folder_ / "song.wav", 8);
  const Outcome outcome = Plot("beats " + At("sway.npz") + " --song " + At("song.wav"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const int line = Drawn(kFirstLine), ink = Drawn(kInk);
  EXPECT_GT(line, 2000) << "the curve and its maxima";
  ASSERT_EQ(Plot("beats " + At("sway.npz") + " --half-time --song " + At("song.wav")).code, 0);
  EXPECT_LT(Drawn(kInk), ink - 200) << "half of the beats";
  WriteWav(folder_ / "song.wav", std::vector<float>(8 * 22050));
  ASSERT_EQ(Plot("beats " + At("sway.npz") + " --song " + At("song.wav")).code, 0);
  EXPECT_LT(Drawn(kInk), ink - 500) << "silence has no beats";
  EXPECT_NEAR(Drawn(kFirstLine), line, 10);
}

// Who corrects the beats of a song does so in each command.
TEST_F(PlotCommandTest, EachCommandThatHearsASongTakesTheSameOptionsOfBeats) {
  for (const char* command : {"analyze", "dance", "edit", "transition", "plot"}) {
    const Outcome outcome = Choreo(std::string(command) + " --help");
    for (const char* option : {"--beats", "--tempo", "--half-time", "--double-time", "--downbeat"})
      EXPECT_THAT(outcome.said, HasSubstr(option)) << command;
  }
}

TEST_F(PlotCommandTest, NamesMotionsThatDoNotFit) {
  const std::string both = At("slow.npz") + " " + At("fast.npz");
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = Plot(arguments);
    EXPECT_EQ(outcome.code, 1) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "plot.png"));
  };
  EXPECT_THAT(Plot("head " + both).said, HasSubstr("quantity: head not in {path,height,"));
  refused("path " + both + " --label one", "--label: 1 of them for 2 motions");
  refused("trunk " + both + " --path " + At("path.json"), "--path: says nothing of the speed");
  refused("path " + both + " --asked 1", "--asked: goes with a part of the body, not with path");
  refused("beats " + At("slow.npz"), "--song: beats need the song");
  refused("path " + At("slow.npz") + " --song " + At("path.json"), "--song: goes with beats");
  refused("beats " + both + " --song " + At("path.json"),
          "motions: 2, but beats are plotted of one");
  refused("height " + At("slow.npz") + " --path " + At("path.json"), "has no heights");
  EXPECT_EQ(Plot("elbow " + both).code, 2);
}

}  // namespace choreo::plot_command_test
