#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "client/authoring/keys/pose_library.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"

namespace choreo::dance_command_test {

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
  EXPECT_THAT(members, testing::UnorderedElementsAre(
                           "frames", "fps", "output_frames", "output_fps", "seed", "fingerprint",
                           "motion_sketch", "model", "song", "keyframes", "warnings", "faults",
                           "measured_from", "log_likelihood", "beat_hit_rate", "beat_hit_chance",
                           "beat_coverage", "skate_ratio", "support", "max_key_acceleration",
                           "p95_acceleration", "first_frame_latency_s", "real_time_factor"));
  EXPECT_EQ(report["frames"], 300);
  EXPECT_EQ(report["seed"], 3);
  EXPECT_EQ(report["fingerprint"], "fake-1");
  EXPECT_GT(report["p95_acceleration"].get<double>(), 0);
  EXPECT_GT(report["max_key_acceleration"].get<double>(), 0);
  // A beat about every 15 frames, but for the song's ends; four or five frames are near each.
  EXPECT_GT(report["beat_hit_chance"].get<double>(), 0.2);
  EXPECT_GT(report["beat_coverage"].get<double>(), 0);
  EXPECT_LE(report["beat_hit_chance"].get<double>(), 5.0 / 15);
  EXPECT_THAT(outcome.said, HasSubstr("measured in the file"));
  EXPECT_THAT(outcome.said,
              testing::ContainsRegex("(no faults|[0-9]+ faults?: .*song.npz lists them)\n"));
  const Outcome listed =
      Choreo("check --json " + At("song.npz") + " --report " + At("report.json"));
  ASSERT_EQ(listed.code, 0) << listed.said;
  EXPECT_EQ(nlohmann::json::parse(listed.said)["faults"].size(), report["faults"].size());
  ASSERT_GE(report["keyframes"].size(), 4U);
  for (const auto& key : report["keyframes"]) {
    EXPECT_LE(key["final_error_m"].get<double>(), 0.001);
    EXPECT_LE(key["final_error_deg"].get<double>(), 0.1);
    EXPECT_GT(key["max_acceleration"].get<double>(), 0);
    if (key["frame"] > 0) {  // she begins in a key at 0
      EXPECT_GT(key["raw_error_m"].get<double>(), 0);
      EXPECT_GT(key["correction_m"].get<double>(), 0);
    }
    EXPECT_EQ(key["output_frame"], key["frame"]);
    EXPECT_TRUE(key["on_output_frame"].get<bool>());
    EXPECT_LE(key["output_error_m"].get<double>(), 0.001);
    EXPECT_LE(key["output_error_deg"].get<double>(), 0.1);
    // The report agrees with the file.
    const std::string id = key["id"];
    const Pose& pose = authoring::FindLibraryPose(id.substr(id.find('-') + 1)).pose;
    const Pose& danced = motion.frames[key["frame"].get<size_t>()];
    EXPECT_LT((pose.rotations.rightCols(23) - danced.rotations.rightCols(23)).cwiseAbs().maxCoeff(),
              0.01)
        << id;
  }
}

TEST_F(CommandTest, HelpSaysThatAShownDanceIsWrittenToo) {
  EXPECT_THAT(Choreo("dance --help").said, HasSubstr("The file of --out is written, too."));
}

TEST_F(CommandTest, SaysWhichKeysFallBetweenTheFramesOfTheFile) {
  WriteClicks(folder_ / "song.wav", 4);
  Motion walk{.fps = 30, .frames = std::vector<Pose>(90, RestPose(Body()))};
  for (size_t i = 0; i < walk.frames.size(); ++i)
    walk.frames[i].root_position.x() = 0.02 * static_cast<double>(i);
  WriteMotion(folder_ / "walk.bvh", Body(), walk);
  // At 24 a second, frame 24 stands at 1 s; 61/30 s lies between frames 48 and 49.
  const Outcome outcome = Choreo("dance --fps 24 -k " + At("walk.bvh@1,2.033333") + " --report " +
                                 At("r.json") + Server() + At("song.wav"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("1 between the frames of a file at 24 fps"));
  const nlohmann::json report = ReadJson(folder_ / "r.json");
  const Motion motion = ReadMotion(folder_ / "song.npz", Body());
  EXPECT_EQ(report["output_frames"], motion.frames.size());
  EXPECT_EQ(report["output_fps"], 24);
  ASSERT_EQ(report["keyframes"].size(), 2U);
  EXPECT_TRUE(report["keyframes"][0]["on_output_frame"].get<bool>());
  EXPECT_LE(report["keyframes"][0]["output_error_m"].get<double>(), 0.001);
  const nlohmann::json& between = report["keyframes"][1];
  EXPECT_EQ(between["frame"], 61);
  EXPECT_EQ(between["output_frame"], 49);
  EXPECT_FALSE(between["on_output_frame"].get<bool>());
  const double off = ComparePoses(Body(), motion.frames[49], walk.frames[61]).position_m;
  EXPECT_NEAR(between["output_error_m"].get<double>(), off, 1e-4);
  EXPECT_GT(off, 0.001);
}

TEST_F(CommandTest, DancesThroughTheExampleOfTheReadme) {
  WriteClicks(folder_ / "song.wav", 7);
  const Outcome outcome = Choreo("dance -k '" SOURCE_FOLDER "/examples/keys.json'" + Server() +
                                 At("song.wav") + " --report " + At("r.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_EQ(ReadJson(folder_ / "r.json")["keyframes"].size(), 4U);
}

TEST_F(CommandTest, DancesThroughTheExampleInWords) {
  const Outcome outcome = Choreo("dance -k '" SOURCE_FOLDER "/examples/poses.json'" + Server() +
                                 "-o " + At("d.npz") + " --report " + At("r.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, testing::Not(HasSubstr("warning: 0 s")));
  const nlohmann::json report = ReadJson(folder_ / "r.json");
  EXPECT_EQ(report["keyframes"].size(), 10U);  // of which two hold one
  const auto is_held = [](const auto& key) { return key.value("holds", "") == "strong"; };
  EXPECT_EQ(std::ranges::count_if(report["keyframes"], is_held), 2);
  EXPECT_THAT(outcome.said, HasSubstr("8 key poses, each hit"));
  EXPECT_THAT(outcome.said,
              testing::ContainsRegex("\non the way to \"[^\"]+\" \\([0-9.]+ s\\) a joint is "
                                     "pulled [0-9.]+ cm off its free motion, the most of all"));
  EXPECT_TRUE(report["warnings"].empty()) << report["warnings"];
}

TEST_F(CommandTest, TellsWhenKeysFall) {
  WriteClicks(folder_ / "song.wav", 10);
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [
    {"id": "a", "time": "5c", "pose": "stand", "hold": 0.5}, {"id": "b", "time": "9c", "pose": "kick"}]})";
  const auto dance = [&](const std::string& options) {
    const Outcome outcome =
        Choreo("dance " + options + Server() + " -o " + At("d.npz") + " --report " + At("r.json"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return outcome.said;
  };
  const std::string said = dance(At("song.wav") + " -k " + At("keys.json"));
  EXPECT_THAT(said, testing::ContainsRegex("\nkeys: a at 5c, [0-9.]+ s; b at 9c, [0-9.]+ s\n"));
  const nlohmann::json key = ReadJson(folder_ / "r.json")["keyframes"].back();
  EXPECT_EQ(key["count"], 9);
  EXPECT_NEAR(key["time"].get<double>(), key["frame"].get<double>() / 30, 1e-4);
  EXPECT_THAT(dance(At("song.wav") + " --seconds 10"), HasSubstr("\nkeys: "));
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand"}]})";
  EXPECT_THAT(dance("-k " + At("keys.json")), HasSubstr("\nkeys: a at 1 s\n"));
  EXPECT_FALSE(ReadJson(folder_ / "r.json")["keyframes"][0].contains("count"));
}

// The later key replaces the earlier one, as animators expect.
TEST_F(CommandTest, AKeyInAHoldEndsItInTimeForTheWay) {
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "hold": 3},
                           {"id": "b", "time": 2, "pose": "kick"}]})";
  const Outcome outcome = Choreo("dance -k " + At("keys.json") + Server() + "-o " + At("d.npz") +
                                 " --report " + At("r.json") + " --seconds 5");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const std::string said = "key \"a\" is held up to 1.4 s, not 4 s: the key \"b\" comes at 2 s";
  EXPECT_THAT(outcome.said, HasSubstr("warning: 2 s (frame 60): " + said));
  const nlohmann::json report = ReadJson(folder_ / "r.json");
  EXPECT_EQ(report["warnings"][0]["message"], said);
  std::vector<int64_t> frames;
  for (const auto& key : report["keyframes"]) frames.push_back(key["frame"]);
  EXPECT_EQ(frames, (std::vector<int64_t>{30, 36, 42, 60}));
}

TEST_F(CommandTest, DancesWithoutKeysOnRequest) {
  WriteClicks(folder_ / "song.wav", 3);
  const Outcome outcome =
      Choreo("dance --keyframes none " + At("song.wav") + Server() + "--report " + At("r.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_EQ(ReadMotion(folder_ / "song.npz", Body()).frames.size(), 90U);
  EXPECT_TRUE(ReadJson(folder_ / "r.json")["keyframes"].empty());
  const Outcome both = Choreo("dance -k none -k x.json " + At("song.wav") + Server());
  EXPECT_EQ(both.code, 1);
  EXPECT_THAT(both.said, HasSubstr("--keyframes: none cannot be combined with x.json"));
  EXPECT_EQ(Choreo("dance -k none" + Server()).code, 2);  // it says of no length
}

// Beats of the command line take precedence. The rest of the project's settings stay.
TEST_F(CommandTest, OptionsOfBeatsWinOverTheProjects) {
  WriteClicks(folder_ / "song.wav", 6);  // a click every half second
  std::ofstream(folder_ / "p.json") << R"({"studio": 1, "song": "song.wav", "seconds": 6,
    "beats": [[1, 1], [2, 2], [3, 3], [4, 4]], "keyframes": [{"time": 2, "pose": "kick"}]})";
  std::ofstream(folder_ / "beats.txt") << "3\n";
  const auto beats = [&](const std::string& options) {
    const Outcome outcome = Choreo("dance --project " + At("p.json") + Server() + "-o " +
                                   At("d.npz") + " --report " + At("r.json") + options);
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    const nlohmann::json report = ReadJson(folder_ / "r.json");
    EXPECT_EQ(report["keyframes"].size(), 1U) << options;
    // Five frames count for each beat, except at the ends of the dance.
    return std::lround(report["beat_hit_chance"].get<double>() * 180 / 5);
  };
  EXPECT_EQ(beats(""), 4);
  EXPECT_GT(beats(" --beats auto"), 7);
  EXPECT_EQ(beats(" --beats " + At("beats.txt")), 1);
  EXPECT_GT(beats(" --tempo 120"), 7);
  EXPECT_EQ(beats(" --half-time"), 2);
  EXPECT_EQ(beats(" --double-time"), 7);
  EXPECT_EQ(beats(" --downbeat 2"), 4);
}

TEST_F(CommandTest, ProjectsBeatsBehindTheSongAreToldOf) {
  WriteClicks(folder_ / "song.wav", 3);
  std::ofstream(folder_ / "p.json") << R"({"studio": 1, "song": "song.wav",
    "beats": [[1, 1], [2, 2], [3, 3], [4, 4], [5, 5]], "keyframes": []})";
  const Outcome outcome =
      Choreo("dance --project " + At("p.json") + Server() + "--seconds 2 -o " + At("d.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said,
              HasSubstr("p.json:beats: 2 beats are left out, behind the end of the song at 3 s"));
}

TEST_F(CommandTest, BeginsAtTheRequestedSecondOfTheSong) {
  WriteClicks(folder_ / "song.wav", 6);
  const Outcome outcome =
      Choreo("dance --song-start 2.5 -k none " + At("song.wav") + Server() + "-o " + At("d.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_EQ(ReadMotion(folder_ / "d.npz", Body()).frames.size(), 105U);
  const Outcome late = Choreo("dance --song-start 7 " + At("song.wav") + Server());
  EXPECT_EQ(late.code, 1);
  EXPECT_THAT(late.said, HasSubstr("--song-start: 7 s is after the end of"));
  for (const std::string& without :
       {"dance --seconds 2" + Server(), "edit --loop " + At("d.npz") + " -o " + At("e.npz"),
        "render --video " + At("d.mp4") + " " + At("d.npz"), "live" + Server()}) {
    const Outcome refused = Choreo(without + " --song-start 1");
    EXPECT_EQ(refused.code, 2) << without;
    EXPECT_THAT(refused.said, HasSubstr("--song-start: needs a song"));
  }
}

TEST_F(CommandTest, AKeyAtTheVeryEndIsDancedOnTheLastFrame) {
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [
    {"time": 0, "pose": "stand"}, {"id": "end", "time": 3, "pose": "kick"}]})";
  const std::string dance = "dance -k " + At("keys.json") + Server() + "-o " + At("d.npz");
  ASSERT_EQ(Choreo(dance + " --seconds 3 --report " + At("r.json")).code, 0);
  EXPECT_EQ(ReadJson(folder_ / "r.json")["keyframes"][1]["frame"], 89);
  EXPECT_THAT(Choreo(dance + " --seconds 2.9").said, HasSubstr("is after the dance's end"));
}

// A dance begins in the pose of its first frame, from which one frame is no way.
TEST_F(CommandTest, AKeyBesideTheBeginningIsDancedOnTheFirstFrame) {
  const auto frames = [&](const std::string& key) {
    std::ofstream(folder_ / "keys.json")
        << R"({"keyframes": [{"id": "late", "time": 2.5, "pose": "kick"}, {"id": "a", )" << key
        << "}]}";
    const Outcome outcome = Choreo("dance -k " + At("keys.json") + Server() + "--seconds 3 -o " +
                                   At("d.npz") + " --report " + At("r.json"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    std::vector<int> told;
    const nlohmann::json report = ReadJson(folder_ / "r.json");
    for (const auto& key_told : report["keyframes"]) told.push_back(key_told["frame"]);
    return told;
  };
  EXPECT_EQ(frames(R"("time": 0.04, "pose": "groove")"), (std::vector{0, 75}));
  EXPECT_EQ(frames(R"("frame": 1, "pose": "groove")"), (std::vector{0, 75}));
  EXPECT_EQ(frames(R"("time": 0.06, "pose": "groove")"), (std::vector{2, 75}));
  EXPECT_EQ(frames(R"("time": 0.04, "pose": "groove", "hold": 0.3)"), (std::vector{0, 10, 75}));
}

TEST_F(CommandTest, ADanceEndsInAPoseThatIsHeld) {
  WriteClicks(folder_ / "song.wav", 10);
  const auto dance = [&](const std::string& options) {
    const Outcome outcome = Choreo("dance " + At("song.wav") + Server() + "-o " + At("d.npz") +
                                   " --report " + At("r.json") + " --end bow " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return outcome.said;
  };
  const auto expect_ending = [&] {
    const Motion motion = ReadMotion(folder_ / "d.npz", Body());
    const Pose& bow = authoring::FindLibraryPose("bow").pose;
    PoseMask mask;
    mask.root_position = false;
    for (const size_t frame : {size_t{285}, motion.frames.size() - 1})
      EXPECT_LT(ComparePoses(Body(), motion.frames[frame], bow, mask).angle_deg, 0.1) << frame;
    const nlohmann::json report = ReadJson(folder_ / "r.json")["keyframes"];
    const auto end =
        std::ranges::find_if(report, [](const auto& key) { return key["id"] == "end-bow"; });
    ASSERT_NE(end, report.end());
    EXPECT_LE((*end)["frame"].get<int>(), 299 - 30);
    EXPECT_GE((*end)["frame"].get<int>(), 299 - 60);
    EXPECT_EQ((*end)["hit"], 1);
    EXPECT_EQ(report.back()["frame"], 299);
    EXPECT_EQ(report.back()["holds"], "end-bow");
  };
  dance("");
  expect_ending();
  dance("-k none");
  expect_ending();
  // It stands at the last key's place, and replaces the keys after it.
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 5, "pose": "stand", "place": [1, -0.5], "hold": 4},
                           {"id": "b", "time": 9.6, "pose": "kick", "place": [0, 0]}]})";
  const std::string said = dance("-k " + At("keys.json"));
  EXPECT_THAT(said, HasSubstr("note: key \"b\" makes way for the ending\n"));
  expect_ending();
  EXPECT_THAT(ReadJson(folder_ / "r.json")["warnings"].dump(),
              HasSubstr(R"( s, not 9 s: the key \"end-bow\" comes at )"));
  const Motion motion = ReadMotion(folder_ / "d.npz", Body());
  EXPECT_NEAR(motion.frames.back().root_position.x(), 1, 0.3);
  EXPECT_NEAR(motion.frames.back().root_position.z(), -0.5, 0.3);

  std::ofstream(folder_ / "bow.json")
      << R"({"keyframes": [{"id": "own", "time": 0, "pose": "bow", "hold": 0.5}]})";
  const Outcome own = Choreo("dance --seconds 6 -k none" + Server() + "-o " + At("d.npz") +
                             " --end " + At("bow.json"));
  EXPECT_THAT(own.said, HasSubstr("note: --end holds \"own\" to the last frame, not for 0.5 s"));

  const Outcome brief =
      Choreo("dance --seconds 2 --end bow -k none" + Server() + "-o " + At("d.npz"));
  EXPECT_EQ(brief.code, 1);
  EXPECT_THAT(brief.said, HasSubstr("--end: the dance has its last frame at 1.97 s"));
}

TEST_F(CommandTest, TheSameSeedWritesTheSameBytes) {
  WriteClicks(folder_ / "song.wav", 3);
  const auto dance = [&](const std::string& name) {
    EXPECT_EQ(Choreo("dance --seed 5 " + At("song.wav") + Server() + "-o " + At(name)).code, 0);
    std::ifstream file(folder_ / name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  const std::string first = dance("a.NPZ");
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(first == dance("b.npz"));
}

TEST_F(CommandTest, DancesNoLongerThanTheSongAndSaysSo) {
  WriteClicks(folder_ / "song.wav", 3);
  const Outcome outcome = Choreo("dance --seconds 60 " + At("song.wav") + Server());
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("--seconds 60 is beyond the song, which ends at 3 s"));
  EXPECT_EQ(ReadMotion(folder_ / "song.npz", Body()).frames.size(), 90U);
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

}  // namespace choreo::dance_command_test
