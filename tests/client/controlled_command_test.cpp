#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "model/formats/motion_file.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"

namespace choreo::controlled_command_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// A model that takes no music.
class SilentSampler final : public ControlledSampler {
 public:
  SilentSampler() { model_.takes_music = false; }
};

/// A model that draws nothing at random.
class DeterministicSampler final : public ControlledSampler {
 public:
  DeterministicSampler() { model_.deterministic = true; }
};

class ControlledCommandTest : public CommandTest {
 protected:
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  void ExpectRefused(const std::string& arguments, const std::string& message) const {
    const Outcome outcome = Choreo("dance" + Walker() + "-o " + At("x.npz") + " " + arguments);
    EXPECT_EQ(outcome.code, 1) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.npz"));
  }
  std::string Walker() const { return " --server " + walker_.address() + " "; }
  Motion Read(const std::string& name) const { return ReadMotion(folder_ / name, Body()); }

  const TestServer walker_{std::make_unique<ControlledSampler>()};
};

constexpr const char* kPath = R"({"about": "a bow", "points": [
  {"time": 0, "x": 0, "z": 0}, {"frame": 60, "x": 1, "z": 0}, {"time": 4, "x": 1, "z": 2}]})";

TEST_F(ControlledCommandTest, DancesAlongAPathWithoutASong) {
  Write("path.json", kPath);
  const Outcome outcome = Choreo("dance" + Walker() + "--path " + At("path.json") +
                                 " --velocity left_arm=1.5 -o " + At("d.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion motion = Read("d.npz");
  ASSERT_EQ(motion.frames.size(), 121U);
  EXPECT_LT((motion.frames[60].root_position - Eigen::Vector3d(1, 0, 0))
                .cwiseProduct(Eigen::Vector3d(1, 0, 1))
                .norm(),
            1e-3);
  EXPECT_LT((motion.frames[120].root_position - Eigen::Vector3d(1, 0, 2))
                .cwiseProduct(Eigen::Vector3d(1, 0, 1))
                .norm(),
            1e-3);
  // Key poses of the library are danced on the way, every two seconds.
  EXPECT_THAT(outcome.said, HasSubstr("key poses"));
}

TEST_F(ControlledCommandTest, ADancersReportHasHerPathOnStage) {
  Write("path.json", kPath);
  Write("stage.json", R"({"apart": 0, "dancers": [{"id": "ada", "place": [0, 2]},
    {"id": "ben", "place": [3, 1], "facing": 90, "mirrored": true, "after": 1}]})");
  const Outcome outcome =
      Choreo("dance" + Walker() + "--seconds 6 -k none --path " + At("path.json") +
             " --velocity left_arm=2 --dancers " + At("stage.json") + " -o " + At("d.npz") +
             " --report " + At("r.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  for (const auto& [id, arm] : {std::pair("ada", "left_arm"), {"ben", "right_arm"}}) {
    const Motion motion = Read(std::string("d.") + id + ".npz");
    const nlohmann::json report = ReadJson(folder_ / (std::string("r.") + id + ".json"));
    const nlohmann::json& path = report["path"];
    ASSERT_EQ(path["frames"].size(), 3U);
    for (size_t i = 0; i < 3; ++i) {
      const Pose& pose = motion.frames.at(path["frames"][i].get<size_t>());
      EXPECT_NEAR(pose.root_position.x(), path["points"][2 * i].get<double>(), 0.01) << id << i;
      EXPECT_NEAR(pose.root_position.z(), path["points"][2 * i + 1].get<double>(), 0.01) << id << i;
    }
    EXPECT_THAT(report["velocity"]["parts"].dump(), HasSubstr(arm));
  }
}

TEST_F(ControlledCommandTest, SendsVelocitiesOfEachPart) {
  WriteClicks(folder_ / "song.wav", 4);
  const auto left_hand = [&](const std::string& options) {
    const Outcome outcome =
        Choreo("dance" + Walker() + At("song.wav") + " " + options + " -o " + At("d.npz"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return Read("d.npz").frames[30].rotations(0, Body().Find(kTellingJoints[1]));
  };
  EXPECT_NEAR(left_hand("--velocity left_arm=1.5"), 0.03, 1e-5);
  EXPECT_NEAR(left_hand("--velocity all=0.5 --velocity arms=3"), 0.06, 1e-5);
  EXPECT_NEAR(left_hand("--velocity legs=0"), 0.02, 1e-5);
  EXPECT_NEAR(left_hand("--velocity arms=2 --velocity-reference calm"), 0.004, 1e-5);
}

TEST_F(ControlledCommandTest, SendsSpeedsAndChangingFactors) {
  const auto hands = [&](const std::string& options, size_t frame) {
    const Outcome outcome =
        Choreo("dance" + Walker() + "--seconds 4 " + options + " -o " + At("d.npz"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    const Pose pose = Read("d.npz").frames[frame];
    return std::pair(pose.rotations(0, Body().Find(kTellingJoints[1])),
                     pose.rotations(0, Body().Find(kTellingJoints[2])));
  };
  EXPECT_NEAR(hands("--velocity left_arm=7.5cm", 30).first, 0.075, 1e-5);
  EXPECT_NEAR(hands("--velocity left_arm=7.5cm", 30).second, 0.03, 1e-5) << "as usual";
  Write("v.json", R"({"about": "louder", "factors": [{"time": 1, "arms": 1, "trunk": 1},
                      {"frame": 90, "arms": 3, "trunk": 1}]})");
  const std::string file = "--velocity " + At("v.json");
  EXPECT_NEAR(hands(file, 15).first, 0.02, 1e-5);
  EXPECT_NEAR(hands(file, 45).first, 0.03, 1e-5);
  EXPECT_NEAR(hands(file + " --velocity right_arm=2", 100).first, 0.06, 1e-5);
  EXPECT_NEAR(hands(file + " --velocity right_arm=2", 100).second, 0.06, 1e-5);
  Write("v.json", R"({"speeds": [{"frame": 0, "all": 5}]})");
  EXPECT_NEAR(hands(file, 45).second, 0.05, 1e-5);
}

TEST_F(ControlledCommandTest, APathTooShortForKeysOfTheLibraryIsNamed) {
  Write("path.json", R"({"points": [{"time": 0, "x": 0, "z": 0}, {"time": 1, "x": 0, "z": 1}]})");
  const Outcome outcome = Choreo("dance" + Walker() + "--path " + At("path.json"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("--path: 1.03333 s is shorter than 2 s, the least for"));
}

TEST_F(ControlledCommandTest, BadVelocityFilesAreRefused) {
  const auto refused = [&](const std::string& text, const std::string& message) {
    Write("v.json", text);
    ExpectRefused("--seconds 4 --velocity " + At("v.json"), message);
  };
  refused(R"({"factors": [{"time": 0, "tail": 1}]})",
          "v.json:factors[0].tail: is none of all, arms, legs, trunk, left_arm");
  refused(R"({"factors": [{"time": 0, "arms": 11}]})",
          "v.json:factors[0].arms: 11 is not a number from 0 to 10");
  refused(R"({"speeds": [{"time": 0, "arms": -1}]})",
          "v.json:speeds[0].arms: -1 is not a speed from 0 to 50 cm a frame");
  refused(R"({"factors": [{"time": 0, "arms": 1}, {"time": 1, "legs": 1}]})",
          "v.json:factors[1]: each point must name the same parts, and not all name left_arm");
  refused(R"({"factors": [{"time": 0, "arms": 1, "left_arm": 1}]})",
          "v.json:factors[0].left_arm: names a part twice");
  refused(R"({"factors": [{"time": 1, "arms": 1}, {"time": 0.5, "arms": 1}]})",
          "v.json:factors[1].time: is frame 15, not after that of the point before it, 30");
  refused(R"({"factors": [{"time": 0, "arms": 1}], "speeds": []})",
          "v.json:speeds: cannot be combined with factors");
  refused(R"({"factors": [{"time": 0, "arms": 1}], "unit": "m"})", "v.json:unit: is not known");
  refused("{}", "v.json: has no list \"factors\"");
  refused(R"({"factors": [{"time": 0}]})", "v.json:factors[0]: names no part of the body");
  refused(R"({"factors": [{"time": 20, "arms": 1}]})",
          "v.json: the first point at 20 s is after the dance's end: "
          "its last frame is at 3.97 s");
  refused(R"({"speeds": [{"frame": 120, "arms": 1}]})", "v.json: the first point");
  Write("v.json", R"({"factors": [{"time": 0, "arms": 1}]})");
  const std::string file = "--seconds 4 --velocity " + At("v.json");
  ExpectRefused(file + " --velocity " + At("v.json"), "v.json is a second file");
  ExpectRefused(file + " --velocity legs=1cm", "legs=1cm: multipliers and cm exclude each other");
  ExpectRefused("--seconds 4 --velocity legs=60cm",
                "\"legs=60cm\": \"60cm\" is not a speed from 0 to 50 cm a frame");
  ExpectRefused("--seconds 4 --velocity legs=1cm --velocity-reference calm",
                "--velocity-reference: is for multipliers, not for speeds");
  const Outcome outcome = Choreo("dance" + Walker() + file + " -o " + At("v.json"));
  EXPECT_EQ(outcome.code, 1) << "no output destroys an input";
}

TEST_F(ControlledCommandTest, EditTakesControls) {
  ASSERT_EQ(Choreo("dance" + Walker() + "--seconds 6 -o " + At("d.npz")).code, 0);
  Write("path.json", R"({"points": [{"time": 1, "x": 0, "z": 0}, {"time": 5, "x": 2, "z": 0}]})");
  const Outcome outcome =
      Choreo("edit" + Walker() + At("d.npz") + " --key kick --at 3 --around 1.5 --path " +
             At("path.json") + " --velocity left_arm=7.5cm -o " + At("e.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_NEAR(Read("e.npz").frames[75].rotations(0, Body().Find(kTellingJoints[1])), 0.075, 1e-5);
}

TEST_F(ControlledCommandTest, ADeterministicModelIsDancedToItsLastFrame) {
  const TestServer server(std::make_unique<DeterministicSampler>());
  const Outcome outcome =
      Choreo("dance --server " + server.address() + " --seconds 12 --temperature 1 -o " +
             At("d.npz") + " --report " + At("d.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("is deterministic; --temperature changes nothing"));
  const auto report = ReadJson(folder_ / "d.json");
  EXPECT_EQ(report["keyframes"].back()["frame"], 359);
  EXPECT_THAT(Choreo("info --server " + server.address()).said, HasSubstr("deterministic: --seed"));
}

TEST_F(ControlledCommandTest, DeterministicModelHasNoAlternatives) {
  const TestServer server(std::make_unique<DeterministicSampler>());
  const std::string to = " --server " + server.address() + " -o " + At("t.npz") + " ";
  const auto changes_nothing = [](const char* option) {
    return HasSubstr("is deterministic; " + std::string(option) + " changes nothing");
  };
  Outcome outcome = Choreo("transition --from kick --to groove --seed 3 --candidates 2 -n 40" + to);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said,
              testing::AllOf(changes_nothing("--seed"), changes_nothing("--candidates")));
  EXPECT_FALSE(std::filesystem::exists(At("t.2.npz")));
  outcome = Choreo("edit " + At("t.npz") + " --key kick --at 0.6 --seed 3 --server " +
                   server.address() + " -o " + At("e.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, changes_nothing("--seed"));
  // Here the seed chooses among the library's key poses.
  outcome = Choreo("dance --seconds 4 --seed 3" + to);
  EXPECT_THAT(outcome.said, testing::Not(HasSubstr("changes nothing")));
}

TEST_F(ControlledCommandTest, AnEditWarnsAsAWholeAndNamesItsKeys) {
  ASSERT_EQ(
      Choreo("dance" + Walker() + "--seconds 8 -o " + At("d.npz") + " --report " + At("d.json"))
          .code,
      0);
  const auto keys = ReadJson(folder_ / "d.json")["keyframes"];
  const auto frame = [&](size_t key) { return keys[key]["frame"].get<int64_t>(); };
  const auto warned = [&](int64_t from, int64_t to) {
    Write("path.json", R"({"points": [{"frame": )" + std::to_string(from) +
                           R"(, "x": 3, "z": 0}, {"frame": )" + std::to_string(to) +
                           R"(, "x": 3, "z": 0.1}]})");
    const Outcome outcome = Choreo("edit" + Walker() + At("d.npz") + " --key groove --at " +
                                   std::to_string(static_cast<double>(frame(1)) / 30) +
                                   " --report " + At("d.json") + " --path " + At("path.json") +
                                   " -o " + At("e.npz") + " --new-report " + At("e.json"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    std::string messages;
    const auto report = ReadJson(folder_ / "e.json");
    for (const auto& warning : report["warnings"]) {
      const std::string message = warning["message"];
      messages += message + "\n";
      EXPECT_THAT(outcome.said, HasSubstr(message));
    }
    return messages;
  };
  const std::string nothing = "it has no effect";
  const std::string first = warned(frame(0) + 5, frame(1));
  EXPECT_THAT(first,
              testing::AllOf(HasSubstr("key \"groove\" lies"), testing::Not(HasSubstr(nothing))));
  const std::string second = warned(frame(1) + 5, frame(2));
  const auto next = keys[2]["id"].get<std::string>();
  EXPECT_THAT(second, testing::AllOf(HasSubstr("key \"" + next + "\" lies"),
                                     testing::Not(HasSubstr(nothing))));
  EXPECT_THAT(warned(frame(2) + 5, frame(2) + 20), HasSubstr(nothing));
}

TEST_F(ControlledCommandTest, ATransitionGoesAlongAPathToo) {
  Write("path.json", R"({"points": [{"time": 0, "x": 0, "z": 0, "y": 0.9},
                                    {"time": 1, "x": 0.5, "z": 0.5, "y": 0.4},
                                    {"time": 2, "x": 1, "z": 0, "y": 0.9}]})");
  const Outcome outcome =
      Choreo("transition" + Walker() + "--from contrapposto --to kick -n 60 --path " +
             At("path.json") + " -o " + At("t.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const std::vector<Pose> frames = Read("t.npz").frames;
  EXPECT_NEAR(frames[30].root_position.y(), 0.4, 0.01);
  // A pose of the library stands wherever the path ends.
  EXPECT_NEAR(frames[59].root_position.x(), 0.97, 0.05);
  EXPECT_THAT(outcome.said, Not(HasSubstr("off the root path")));
}

TEST_F(ControlledCommandTest, InfoShowsControlsAndReferences) {
  const Outcome outcome = Choreo("info" + Walker());
  EXPECT_THAT(outcome.said, HasSubstr("control: root path (--path)"));
  EXPECT_THAT(outcome.said, HasSubstr("control: velocity factors (--velocity)"));
  EXPECT_THAT(outcome.said, HasSubstr("velocity reference median, cm a frame: trunk 1.00, left_arm "
                                      "2.00, right_arm 3.00, left_leg 4.00, right_leg 5.00"));
  const Outcome json = Choreo("info --json" + Walker());
  const auto model = nlohmann::json::parse(json.said)["models"][0];
  EXPECT_EQ(model["velocity_references"][1]["name"], "calm");
  EXPECT_EQ(model["takes_music"], true);
}

TEST_F(ControlledCommandTest, ModelWithoutMusicInputDancesToBeats) {
  const TestServer deaf(std::make_unique<SilentSampler>());
  WriteClicks(folder_ / "song.wav", 6);
  const Outcome outcome =
      Choreo("dance --server " + deaf.address() + " " + At("song.wav") + " -o " + At("d.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("the model \"fake\" takes no music"));
  EXPECT_EQ(Read("d.npz").frames.size(), 180U);
}

TEST_F(ControlledCommandTest, BadPathsAreRefused) {
  const auto refused = [&](const std::string& points, const std::string& message) {
    Write("path.json", R"({"points": )" + points + "}");
    ExpectRefused("--path " + At("path.json"), "path.json:" + message);
  };
  refused("[]", "points: is empty");
  refused(R"([{"time": 0, "x": 0, "z": 0}])", "points: has 1 point, a path needs at least 2");
  refused(R"([{"time": 0, "x": 0, "z": 0}, {"time": 0.01, "x": 1, "z": 0}])",
          "points[1].time: is frame 0, as that of the point before it; there may be one a frame, "
          "30 a second");
  refused(R"([{"time": 0, "x": 0, "z": 0}, {"time": 1, "x": 1}])", "points[1].z: is missing");
  refused(R"([{"time": 0, "x": 0, "z": 0}, {"time": 1, "x": "far", "z": 0}])",
          "points[1].x: \"far\" is not a number");
  refused(R"([{"time": 0, "x": 0, "z": 0}, {"x": 1, "z": 0}])",
          "points[1].time: is missing, and so is frame");
  refused(R"([{"time": -1, "x": 0, "z": 0}, {"time": 1, "x": 1, "z": 0}])",
          "points[0].time: -1 s is before 0");
  refused(R"([{"time": 0, "x": 0, "z": 0}, {"time": 1, "x": 1, "z": 0, "y": 1}])",
          "points[1].y: must be in all points or in none");
  refused(R"([{"time": 0, "x": 0, "z": 0}, {"time": 1, "x": 1, "z": 0, "speed": 1}])",
          "points[1].speed: is not known; a point has time or frame, x, z and perhaps y");
  // Errors that only the server finds name the file's fields, too.
  refused(
      R"([{"time": 0, "x": 0, "z": 0}, {"time": 1, "x": 0, "z": 0}, {"time": 2, "x": 0, "z": 20000}])",
      "points[2].z: 20000 m is not within 10000 m of 0");
  refused(R"([{"time": 0, "x": 0, "z": 0, "y": 1}, {"time": 3, "x": 0, "z": 0, "y": 3}])",
          "points[1].y: 3 m above the floor is not in [0, 2]");
  // So do invalid JSON, and the place of its error.
  refused("[{\"time\": 0, \"x\": 0,\n \"z\": 0}, {\"time\": 1, \"x\": NaN}]",
          "points[1].x: is not JSON: cannot be read at line 2, column 28, \"NaN\"");
  refused(R"([{"time": 0, "x": 1e999, "z": 0}])",
          "points[0].x: 1e999 is beyond 1.8e308, the largest number");
  refused(R"([{"time": 0, "x": 1, "x": 2, "z": 0}])", "points[0].x: is there twice");
  ExpectRefused("--path " + At("none.json"), "none.json: cannot be opened");
  const Outcome unset = Choreo("dance" + Walker() + "--seconds 4 --path ''");
  EXPECT_EQ(unset.code, 2) << "a script's variable that is not set";
  EXPECT_THAT(unset.said, HasSubstr("--path: names no file"));
}

TEST_F(ControlledCommandTest, APathOfTenHoursIsRefused) {
  Write("path.json",
        R"({"points": [{"time": 0, "x": 0, "z": 0}, {"time": 36000, "x": 1, "z": 0}]})");
  ExpectRefused("--seconds 10 --path " + At("path.json"),
                "path.json:points[1].time: 36000 s is beyond 3600 s, the longest dance");
  ExpectRefused("--path " + At("path.json"), "path.json:points[1].time: 36000 s is beyond 3600 s");
}

TEST_F(ControlledCommandTest, RefusesInvalidPathFiles) {
  const std::string points =
      R"("points": [{"time": 20, "x": 0, "z": 0}, {"time": 21, "x": 1, "z": 0}])";
  Write("path.json", "{" + points + R"(, "velocity": 2})");
  ExpectRefused("--path " + At("path.json"),
                "path.json:velocity: is not known; a path file has points and perhaps about");
  Write("path.json", "{" + points + ", " + points + "}");
  ExpectRefused("--path " + At("path.json"), "path.json:points: is there twice");
  Write("path.json", "{" + points + "}");
  ExpectRefused("--seconds 10 --path " + At("path.json"),
                "path.json:points[0]: the first point at 20 s is after the dance's end: "
                "its last frame is at 9.97 s");
  Write("v.json", R"({"factors": [{"time": 20, "arms": 1}]})");
  const std::string transition = "transition" + Walker() + "--from groove --to kick --at 18 ";
  for (const std::string& controls : {"--path " + At("path.json"), "--velocity " + At("v.json")}) {
    const Outcome late = Choreo(transition + "-n 60 " + controls + " -o " + At("t.npz"));
    EXPECT_EQ(late.code, 1);
    EXPECT_THAT(late.said, HasSubstr("first point at 20 s is after the dance's end: its last "
                                     "frame is at 19.97 s"));
    const Outcome begun = Choreo(transition + "-n 61 " + controls + " -o " + At("t.npz"));
    EXPECT_EQ(begun.code, 0) << begun.said;
    const Outcome edit = Choreo("edit" + Walker() + At("t.npz") + " --key groove --at 1 " +
                                controls + " -o " + At("e.npz"));
    EXPECT_EQ(edit.code, 1);
    EXPECT_THAT(edit.said, HasSubstr("is after the dance's end: its last frame is at 2 s"));
  }
}

TEST_F(ControlledCommandTest, TheReportHasTheWarnings) {
  Write("path.json", R"({"points": [{"time": 0, "x": 0, "z": 0}, {"time": 1, "x": 9, "z": 0}]})");
  const Outcome outcome = Choreo("dance" + Walker() + "--seconds 4 --path " + At("path.json") +
                                 " -o " + At("d.npz") + " --report " + At("d.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("m/s; people reach 5"));
  const auto warnings = ReadJson(folder_ / "d.json")["warnings"];
  const auto warning = std::ranges::find_if(warnings, [](const auto& one) {
    return one["message"].template get<std::string>().ends_with("people reach 5");
  });
  ASSERT_NE(warning, warnings.end());
  EXPECT_LE((*warning)["frame"], 30);
}

TEST_F(ControlledCommandTest, BadVelocitiesAreRefused) {
  const std::string dance = "--seconds 4 ";
  ExpectRefused(dance + "--velocity tail=1",
                "--velocity: \"tail\" is none of all, arms, legs, trunk, left_arm");
  ExpectRefused(dance + "--velocity trunk=-1",
                "--velocity: \"trunk=-1\": \"-1\" is not a number from 0 to 10");
  ExpectRefused(dance + "--velocity trunk=nan", "\"nan\" is not a number from 0 to 10");
  ExpectRefused(dance + "--velocity trunk=11", "\"11\" is not a number from 0 to 10");
  ExpectRefused(dance + "--velocity trunk", "--velocity: \"trunk\": \"\" is not a number");
  ExpectRefused(dance + "--velocity-reference calm", "--velocity-reference: needs a velocity");
  ExpectRefused(dance + "--velocity all=1 --velocity-reference wild",
                "--velocity-reference: \"wild\" is none of the model's, median, calm");
  const Outcome outcome = Choreo("dance" + Walker() + "--velocity all=1");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.said, HasSubstr("A song, or else --keyframes, --path or --seconds"));
}

TEST_F(ControlledCommandTest, ModelWithoutControlsRefusesThem) {
  Write("path.json", kPath);
  Outcome outcome = Choreo("dance" + Server() + "--path " + At("path.json") + " -o " + At("x.npz"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(
      outcome.said,
      HasSubstr("--path: the model \"fake\" does not have this control, and no other model"));
  outcome = Choreo("transition" + Server() + "--from kick --to groove --velocity all=2 -o " +
                   At("x.npz"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("--velocity: the model \"fake\" does not have this control"));
}

}  // namespace choreo::controlled_command_test
