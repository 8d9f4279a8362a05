#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "client/authoring/project/project_file.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"
#include "tests/support/expect_error.h"
#include "tests/support/music_files.h"

namespace choreo::project_test {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ProjectBeats, ReplaceEarlierOnes) {
  authoring::Project project;
  project.SetBeats({1, 2, 3}, {1, 4, 5}, 4, "p");
  project.SetBeats({10, 11, 12, 13}, {1, 3, 5, 1}, 2, "p");
  EXPECT_THAT(project.beats, ElementsAre(10, 11, 12, 13));
  EXPECT_THAT(project.counts, ElementsAre(1, 3, 5, 1));
  EXPECT_THAT(project.downbeats, ElementsAre(10, 11, 12, 13));
  EXPECT_THAT(project.ones, ElementsAre(10, 13));
  EXPECT_EQ(project.bar, 2);
}

TEST(ProjectBeats, StayAsTheyAreIfTheNewOnesAreRefused) {
  authoring::Project project;
  project.SetBeats({1, 2, 3}, {1, 4, 5}, 4, "p");
  ExpectError(ErrorCode::kInvalidArgument, "p:beats[1]", [&] {
    project.SetBeats({10, 11}, {1, 17}, 2, "p");
  });
  EXPECT_THAT(project.beats, ElementsAre(1, 2, 3));
  EXPECT_THAT(project.counts, ElementsAre(1, 4, 5));
  EXPECT_THAT(project.downbeats, ElementsAre(1, 3));
  EXPECT_THAT(project.ones, ElementsAre(1));
  EXPECT_EQ(project.bar, 4);
}

/// `choreo dance --project`, with what the studio saves.
class ProjectTest : public testing::Test {
 protected:
  ProjectTest() {
    project_ = {
        {"studio", 1}, {"song", "song.wav"}, {"seconds", 4}, {"seed", 3}, {"style", "wild"}};
    project_["lively"] = {{"trunk", 1}, {"left arm", 1.5}, {"right arm", 1}};
    const json joint = {0.1, 0.0, 0.2};
    project_["keyframes"] = {{{"id", "bow"}, {"time", 2}, {"rotations", json::array()}}};
    for (int i = 0; i < 24; ++i) project_["keyframes"][0]["rotations"].push_back(joint);
    WriteClicks(folder_ / "song.wav", 5);
  }

  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  Outcome Dance(const std::string& arguments, const std::string& out) const {
    std::ofstream(folder_ / "p.json") << project_.dump();
    return Choreo("dance --server " + server_.address() + " -o " + At(out) + " " + arguments);
  }
  std::string Bytes(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void ExpectRefused(const std::string& message) const {
    const Outcome outcome = Dance("--project " + At("p.json"), "x.bvh");
    EXPECT_EQ(outcome.code, 1) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr(message));
  }

  TemporaryFolder folder_;
  const TestServer server_{std::make_unique<ControlledSampler>()};
  json project_;
};

TEST_F(ProjectTest, WithoutKeysIsDancedWithoutAny) {
  project_["keyframes"] = json::array();
  const Outcome outcome = Dance("--project " + At("p.json"), "a.bvh");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Outcome spelt = Dance(
      At("song.wav") + " -k none --seed 3 --seconds 4 --style wild" + " --velocity left_arm=1.5",
      "b.bvh");
  ASSERT_EQ(spelt.code, 0) << spelt.said;
  EXPECT_EQ(Bytes("a.bvh"), Bytes("b.bvh"));
}

TEST_F(ProjectTest, IsDancedWithItsSettings) {
  const Outcome outcome = Dance("--project " + At("p.json"), "a.bvh");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Outcome spelt = Dance(At("song.wav") + " -k " + At("p.json") +
                                  " --seed 3 --seconds 4 --style wild --velocity left_arm=1.5",
                              "b.bvh");
  ASSERT_EQ(spelt.code, 0) << spelt.said;
  EXPECT_THAT(Bytes("a.bvh"), HasSubstr("Frames: 120\n"));
  EXPECT_EQ(Bytes("a.bvh"), Bytes("b.bvh"));
}

TEST_F(ProjectTest, MarkersChangeNoFrameAndAreChecked) {
  ASSERT_EQ(Dance("--project " + At("p.json"), "a.bvh").code, 0);
  project_["markers"] = {{{"time", 0}, {"name", "intro"}}, {{"time", 2.5}, {"name", "drop"}}};
  ASSERT_EQ(Dance("--project " + At("p.json"), "b.bvh").code, 0);
  EXPECT_EQ(Bytes("a.bvh"), Bytes("b.bvh"));
  project_["markers"][1]["time"] = 0;
  ExpectRefused("p.json:markers[1].time: 0 is not above the one before it and up to 3600");
  project_["markers"] = {{{"time", 1}}};
  ExpectRefused("p.json:markers[0].name: is missing");
}

TEST_F(ProjectTest, AHitChangesTheWayToItsKey) {
  ASSERT_EQ(Dance("--project " + At("p.json"), "a.bvh").code, 0);
  project_["keyframes"][0]["hit"] = 3;
  ASSERT_EQ(Dance("--project " + At("p.json"), "b.bvh").code, 0);
  EXPECT_NE(Bytes("a.bvh"), Bytes("b.bvh"));
}

TEST_F(ProjectTest, TheCommandLineWins) {
  ASSERT_EQ(Dance("--project " + At("p.json"), "wild.bvh").code, 0);
  ASSERT_EQ(Dance("--project " + At("p.json") + " --style calm", "calm.bvh").code, 0);
  ASSERT_EQ(Dance("--project " + At("p.json") + " --velocity left_arm=1", "slow.bvh").code, 0);
  ASSERT_EQ(Dance("--project " + At("p.json") + " --seconds 3", "short.bvh").code, 0);
  EXPECT_NE(Bytes("wild.bvh"), Bytes("calm.bvh"));
  EXPECT_NE(Bytes("wild.bvh"), Bytes("slow.bvh"));
  EXPECT_THAT(Bytes("short.bvh"), HasSubstr("Frames: 90\n"));
}

TEST_F(ProjectTest, IsDancedToItsMusic) {
  std::vector<float> swelling = Clicks(5);
  for (size_t i = 0; i < swelling.size() / 4; ++i) swelling[i] *= 0.05F;
  WriteWav(folder_ / "song.wav", swelling);
  project_.erase("lively");
  ASSERT_EQ(Dance("--project " + At("p.json"), "usual.bvh").code, 0);
  project_["music_dynamics"] = 1;
  project_["variation"] = 0;
  ASSERT_EQ(Dance("--project " + At("p.json"), "lively.bvh").code, 0);
  const Outcome usual =
      Dance("--project " + At("p.json") + " --music-dynamics 0.5 --variation 0.3", "as_usual.bvh");
  ASSERT_EQ(usual.code, 0) << usual.said;
  EXPECT_EQ(Bytes("as_usual.bvh"), Bytes("usual.bvh"));
  project_.erase("music_dynamics");
  project_.erase("variation");
  ASSERT_EQ(
      Dance("--project " + At("p.json") + " --music-dynamics 1 --variation 0", "told.bvh").code, 0);
  EXPECT_EQ(Bytes("told.bvh"), Bytes("lively.bvh"));
  EXPECT_TRUE(Bytes("usual.bvh") != Bytes("lively.bvh"));
}

TEST_F(ProjectTest, ItsBeatsAreThoseOfItsSong) {
  ASSERT_EQ(Dance("--project " + At("p.json"), "found.bvh").code, 0);
  project_["beats"] = {{0.4, 1}, {1.2, 2}, {2.0, 3}, {2.8, 4}};
  project_["bar"] = 4;
  const Outcome outcome = Dance("--project " + At("p.json"), "said.bvh");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  std::ofstream(folder_ / "beats.txt") << "0.4\n1.2\n2\n2.8\n";
  WriteClicks(folder_ / "other.wav", 5);
  // The command line wins, and another song has beats of its own.
  const json beats = project_["beats"];
  project_["beats"] = {{0.1, 1}};
  ASSERT_EQ(Dance("--project " + At("p.json") + " --beats " + At("beats.txt"), "told.bvh").code, 0);
  ASSERT_EQ(Dance(At("other.wav") + " --project " + At("p.json"), "other.bvh").code, 0);
  EXPECT_TRUE(Bytes("told.bvh") == Bytes("said.bvh"));
  EXPECT_TRUE(Bytes("other.bvh") == Bytes("found.bvh"));
  EXPECT_TRUE(Bytes("said.bvh") != Bytes("found.bvh"));
  // Those of a song that is danced to from its second 1 on.
  project_["beats"] = beats;
  ASSERT_EQ(Dance("--project " + At("p.json") + " --seconds 3 --song-start 1", "late.bvh").code, 0);
  project_["beats"] = {{1.2, 1}, {2.0, 2}, {2.8, 3}};
  ASSERT_EQ(Dance("--project " + At("p.json") + " --seconds 3 --song-start 1", "same.bvh").code, 0);
  EXPECT_EQ(Bytes("late.bvh"), Bytes("same.bvh"));
}

TEST_F(ProjectTest, ItsBeatsAreWithinItsSong) {
  project_["beats"] = {{100, 1}, {101, 2}};
  ExpectRefused(
      "p.json:beats: has no beat within the part of the song that is heard, its first 5 ");
  project_["beats"] = {{1, 1}, {2, 2}};
  const Outcome late = Dance("--project " + At("p.json") + " --song-start 3", "late.bvh");
  EXPECT_THAT(late.said, HasSubstr("p.json:beats: has no beat after second 3"));
  project_.erase("song");
  ExpectRefused("p.json:beats: need a song");
}

TEST_F(ProjectTest, ItsPathLeadsAsAPathFileDoes) {
  ASSERT_EQ(Dance("--project " + At("p.json"), "anywhere.bvh").code, 0);
  const json path = {
      {"points", {{{"frame", 0}, {"x", 0}, {"z", 0}}, {{"frame", 90}, {"x", 1}, {"z", 1}}}}};
  std::ofstream(folder_ / "path.json") << path.dump();
  const Outcome spelt =
      Dance("--project " + At("p.json") + " --path " + At("path.json"), "spelt.bvh");
  ASSERT_EQ(spelt.code, 0) << spelt.said;
  project_["path"] = path;
  const Outcome outcome = Dance("--project " + At("p.json"), "path.bvh");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_EQ(Bytes("path.bvh"), Bytes("spelt.bvh"));
  EXPECT_NE(Bytes("path.bvh"), Bytes("anywhere.bvh"));
  // The command line wins.
  project_["path"]["points"][1]["x"] = 2;
  ASSERT_EQ(Dance("--project " + At("p.json") + " --path " + At("path.json"), "won.bvh").code, 0);
  EXPECT_EQ(Bytes("won.bvh"), Bytes("spelt.bvh"));
}

// Older projects say them in other words.
TEST_F(ProjectTest, HasTheControlsOfTheApi) {
  project_["path"] = {
      {"points", {{{"frame", 0}, {"x", 0}, {"z", 0}}, {{"frame", 90}, {"x", 1}, {"z", 1}}}}};
  ASSERT_EQ(Dance("--project " + At("p.json"), "older.bvh").code, 0);
  project_.erase("path");
  project_.erase("lively");
  project_["controls"] = {
      {"root_path", {{"frames", {0, 90}}, {"points", {0, 0, 1, 1}}}},
      {"velocity_factors",
       {{"parts", {"trunk", "left_arm", "right_arm"}}, {"factors", {1, 1.5, 1}}}}};
  const Outcome outcome = Dance("--project " + At("p.json"), "newer.bvh");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_EQ(Bytes("newer.bvh"), Bytes("older.bvh"));
}

TEST_F(ProjectTest, NamesAMissingSong) {
  project_["song"] = "other.wav";
  ExpectRefused("p.json:song: ");
  const Outcome outcome = Dance(At("song.wav") + " --project " + At("p.json"), "a.bvh");
  EXPECT_EQ(outcome.code, 0) << outcome.said;
}

TEST_F(ProjectTest, WithoutASongItIsSilent) {
  project_["song"] = "";
  const Outcome outcome = Dance("--project " + At("p.json"), "a.bvh");
  EXPECT_EQ(outcome.code, 0) << outcome.said;
}

TEST_F(ProjectTest, NamesInvalidFields) {
  const json good = project_;
  const auto with = [&](const char* member, const json& value, const std::string& message) {
    project_ = good;
    project_[member] = value;
    ExpectRefused(std::string("p.json:") + member + message);
  };
  with("studio", 2, ": is format 2, known is 1");
  with("sead", 1, ": is not known; a project has studio");
  with("seconds", 0, ": 0 is not above 0 and up to 3600");
  with("seconds", 1e300, ": 1e+300 is not above 0 and up to 3600");
  with("seed", -1, ": -1 is not a whole number from 0 on");
  with("song", 7, ": 7 is not a text");
  with("lively", {{"tail", 1}}, ".tail: is none of trunk");
  with("lively", {{"trunk", 11}}, ".trunk: 11 is not a number from 0 to 10");
  with("controls", {{"gaze", json::object()}}, ".gaze: is none of root_path, velocity_factors");
  with("controls", {{"root_path", {{"frames", {0, 90}}}}},
       ".root_path: does not fit the API's message");
  with("music_dynamics", 1.5, ": 1.5 is not in [0, 1]");
  with("variation", -1, ": -1 is not in [0, 1]");
  with("beats", 7, ": 7 is not a list");
  with("beats", {7}, "[0]: 7 is not a beat: its second and its count, 1 to 16, as in [12.5, 1]");
  with("beats", json::array({{0.5, 17}}), "[0]: [0.5,17] is not a beat");
  with("beats", json::array({{601, 1}}), "[0]: 601 s is not within 0 to 600");
  with("beats", {{1, 1}, {1, 2}}, "[1]: 1 s is not after the beat before it, 1 s");
  with("bar", 0, ": 0 is not a whole number from 1 to 16");
  with("path", 7, ": 7 is not an object");
  with("path", {{"points", json::array()}}, ":points");
  with("path",
       {{"points", {{{"frame", 0}, {"x", 0}, {"z", 0}}, {{"frame", 0}, {"x", 1}, {"z", 0}}}}},
       ":points[1].frame");
  with("path",
       {{"points", {{{"frame", 9}, {"x", 2e4}, {"z", 0}}, {{"frame", 12}, {"x", 1}, {"z", 0}}}}},
       ":points[0].x");
  project_ = good;
  project_["style"] = "foxtrot";
  ExpectRefused("p.json:style: \"foxtrot\"");
  project_ = good;
  project_.erase("studio");
  ExpectRefused(
      "p.json:studio: is missing: a project says \"studio\": 1; a key file goes with choreo");
  project_ = good;
  project_.erase("keyframes");
  ExpectRefused("p.json: has no list");
}

}  // namespace choreo::project_test
