#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "client/authoring/keys/pose_library.h"
#include "model/motion/kinematics/canonical.h"
#include "tests/client/edit_fixture.h"

namespace choreo::edit_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

// Four counts of two a second take four seconds in half time.
TEST_F(EditTest, UsesTheRequestedBeats) {
  const auto repeat = [&](const std::string& options) {
    return Edit("--repeat 0 1 4c --song " + At("song.wav") + options + " --report " +
                At("report.json") + " -o " + At("new.npz") + " --new-report " + At("new.json"));
  };
  const auto has_key_at = [&](int frame) {
    const nlohmann::json report = ReadJson(folder_ / "new.json");
    return std::ranges::any_of(report["keyframes"], [&](const auto& key) {
      return std::abs(key["frame"].template get<int>() - frame) <= 2;
    });
  };
  ASSERT_EQ(repeat("").code, 0);
  EXPECT_TRUE(has_key_at(60));
  const Outcome half = repeat(" --half-time");
  ASSERT_EQ(half.code, 0) << half.said;
  EXPECT_TRUE(has_key_at(120));
}

TEST_F(EditTest, AKeyChangesTheTwoIntervalsAroundItAlone) {
  const Outcome outcome =
      Edit("--key kick --at " + Seconds(keys_[2]) + " --song " + At("song.wav") + " --report " +
           At("report.json") + " -o " + At("new.npz") + " --new-report " + At("new.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  ExpectChanged("new.npz", keys_[1] + 1, keys_[3]);

  // The pose is reached where the dancer was.
  const Motion before = Read("dance.npz");
  const Motion after = Read("new.npz");
  const Pose& there = after.frames[keys_[2]];
  const GroundFrame place = GroundFrame::Of(before.frames[keys_[2]]);
  const PoseError error =
      ComparePoses(Body(), there, place.ToWorld(authoring::FindLibraryPose("kick").pose));
  EXPECT_LE(error.position_m, 0.001);
  EXPECT_LE(error.angle_deg, 0.1);

  // The report lists it in place of the key that stood there.
  const auto reported = ReadJson(folder_ / "new.json")["keyframes"];
  ASSERT_EQ(reported.size(), keys_.size());
  EXPECT_EQ(reported[2]["id"], "kick");
  EXPECT_EQ(reported[2]["frame"], keys_[2]);
  EXPECT_LE(reported[2]["final_error_m"], 0.001);
}

TEST_F(EditTest, ReportKeepsWarningsOfUnchangedParts) {
  nlohmann::json report = ReadJson(folder_ / "report.json");
  report["warnings"] = nlohmann::json::array();
  for (const size_t frame : {keys_[3] + 1, keys_[3], keys_[1] + 1, keys_[1]})
    report["warnings"].push_back({{"frame", frame}, {"message", std::to_string(frame)}});
  std::ofstream(folder_ / "warned.json") << report;
  const std::string edit = "--key kick --at " + Seconds(keys_[2]) + " --report " +
                           At("warned.json") + " -o " + At("new.npz") + " --new-report ";
  const Outcome outcome = Edit(edit + At("new.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  // The motion to keys_[3] has changed.
  std::vector<size_t> frames;
  const nlohmann::json edited = ReadJson(folder_ / "new.json");
  for (const auto& warning : edited["warnings"]) {
    if (warning["message"] == std::to_string(warning["frame"].get<size_t>()))
      frames.push_back(warning["frame"]);
  }
  EXPECT_EQ(frames, (std::vector{keys_[1], keys_[3] + 1}));

  const auto refused = [&](const std::string& message) {
    std::ofstream(folder_ / "warned.json") << report;
    const Outcome bad = Edit(edit + At("bad.json"));
    EXPECT_EQ(bad.code, 1);
    EXPECT_THAT(bad.said, HasSubstr(message));
  };
  report["warnings"][1].erase("message");
  refused("warned.json:warnings[1]: has no message, or no frame");
  for (const nlohmann::json& no_list : {nlohmann::json(), nlohmann::json::object()}) {
    report["warnings"] = no_list;
    refused("warned.json:warnings: is not a list");
  }
}

// The engine of this test begins every transition from standstill: joins can't be smoother than the
// keys of an undisturbed dance, and must not be rougher.
TEST_F(EditTest, JoinsAreAsSmoothAsTheDance) {
  ASSERT_EQ(Edit("--key groove --at " + Seconds(keys_[2]) + " --report " + At("report.json") +
                 " -o " + At("new.npz"))
                .code,
            0);
  const Motion before = Read("dance.npz");
  const Motion after = Read("new.npz");
  const double usual = LargestAcceleration(before, 2, before.frames.size() - 3);
  for (const size_t join : {keys_[1], keys_[2], keys_[3]}) {
    EXPECT_LE(LargestAcceleration(after, join - 2, join + 2), 1.2 * usual) << join;
  }
}

TEST_F(EditTest, ALoopLeadsBackIntoTheFirstFrame) {
  ASSERT_EQ(Edit("--loop --around 3 -o " + At("loop.npz")).code, 0);
  const Motion before = Read("dance.npz");
  const Motion loop = Read("loop.npz");
  ASSERT_EQ(loop.frames.size(), 300U);
  ExpectChanged("loop.npz", 300 - 90, 300);
  const double usual = LargestAcceleration(before, 2, before.frames.size() - 3);
  EXPECT_GT(LargestAcceleration(before, 298, 301), 2 * usual) << "it was a loop already";
  // The pelvis comes back to a key from where its feet are; those of random weights are far off.
  EXPECT_LE(LargestAcceleration(loop, 298, 301), 1.6 * usual);
}

TEST_F(EditTest, KeepsFramesAtAnotherRate) {
  ASSERT_EQ(
      Choreo("dance " + At("song.wav") + Server() + "--seed 3 --fps 60 -o " + At("dance.npz")).code,
      0);
  ASSERT_EQ(Edit("--key kick --at 5 -o " + At("new.npz")).code, 0);
  ExpectChanged("new.npz", 181, 420);  // 2 s around frame 300, at 60 a second
  const Motion after = Read("new.npz");
  EXPECT_EQ(after.fps, 60);
  const GroundFrame place = GroundFrame::Of(Read("dance.npz").frames[300]);
  EXPECT_LE(ComparePoses(Body(), after.frames[300],
                         place.ToWorld(authoring::FindLibraryPose("kick").pose))
                .position_m,
            0.001);

  // 599 frames last up to the 300th of the model's; the loop takes as long as 300 of them.
  ASSERT_EQ(Edit("--loop -o " + At("loop.npz")).code, 0);
  const Motion loop = Read("loop.npz");
  EXPECT_EQ(loop.frames.size(), 600U);
  const double step = (loop.frames[0].root_position - loop.frames[599].root_position).norm();
  const double usual = (loop.frames[599].root_position - loop.frames[598].root_position).norm();
  EXPECT_NEAR(step, usual, 0.5 * usual + 0.002);
}

TEST_F(EditTest, SeveralKeysAtOnceAndTheSameBytesAgain) {
  const std::string arguments = "--key kick --at 3 --key groove --at 6.5 --around 1 --loop ";
  ASSERT_EQ(Edit(arguments + "-o " + At("a.npz")).code, 0);
  ASSERT_EQ(Edit(arguments + "-o " + At("b.npz")).code, 0);
  ASSERT_EQ(Edit(arguments + "--seed 1 -o " + At("c.npz")).code, 0);
  const auto bytes = [this](const char* name) {
    std::ifstream file(folder_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes("a.npz"), bytes("b.npz"));
  EXPECT_NE(bytes("a.npz"), bytes("c.npz"));
  const Motion before = Read("dance.npz");
  const Motion after = Read("a.npz");
  const auto kept = [&](size_t frame) {
    return before.frames[frame].rotations == after.frames[frame].rotations;
  };
  for (const size_t frame : {0, 60, 120, 164, 165, 225, 269}) EXPECT_TRUE(kept(frame)) << frame;
  for (const size_t frame : {61, 90, 119, 166, 195, 224, 270, 299}) EXPECT_FALSE(kept(frame));
}

TEST_F(EditTest, TheFirstAndTheLastFrameCanBeKeys) {
  ASSERT_EQ(
      Edit("--key kick --at 0 --key groove --at " + Seconds(299) + " -o " + At("new.npz")).code, 0);
  const Motion after = Read("new.npz");
  const Motion before = Read("dance.npz");
  const auto error = [&](size_t frame, const char* pose) {
    const GroundFrame place = GroundFrame::Of(before.frames[frame]);
    return ComparePoses(Body(), after.frames[frame],
                        place.ToWorld(authoring::FindLibraryPose(pose).pose));
  };
  EXPECT_LE(error(0, "kick").position_m, 0.001);
  EXPECT_LE(error(299, "groove").position_m, 0.001);
  EXPECT_EQ(before.frames[60].rotations, after.frames[60].rotations);
  EXPECT_EQ(before.frames[239].rotations, after.frames[239].rotations);
}

TEST_F(EditTest, EditsADanceOfSeveralTurns) {
  Motion spin{.fps = 30, .frames = std::vector<Pose>(120, RestPose(Body()))};
  for (size_t i = 0; i < spin.frames.size(); ++i)
    spin.frames[i].rotations(1, 0) = 4 * M_PI * static_cast<double>(i) / 119;
  WriteMotion(folder_ / "spin.bvh", Body(), spin);
  const Outcome outcome = Choreo("edit " + At("spin.bvh") + Server() +
                                 "--key kick --at 2 --around 1 -o " + At("e.bvh"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion edited = Read("e.bvh");
  ASSERT_EQ(edited.frames.size(), spin.frames.size());
  EXPECT_LT(ComparePoses(Body(), edited.frames[110], spin.frames[110]).position_m, 1e-4);
}

// The first new frames continue the numbers of those before, and the last ones are as they were.
TEST_F(EditTest, KeepsTheNumbersOfADanceOfSeveralTurns) {
  Motion spin{.fps = 30, .frames = std::vector<Pose>(120, RestPose(Body()))};
  for (size_t i = 0; i < spin.frames.size(); ++i)
    spin.frames[i].rotations(1, 0) = 4 * M_PI * static_cast<double>(i) / 119;
  WriteMotion(folder_ / "dance.npz", Body(), spin);
  const Outcome outcome = Edit("--key kick --at 3 --around 0.5 -o " + At("new.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  for (const char* key : {"rotations", "poses"}) {
    const auto [first, end] = ChangedRows(folder_ / "dance.npz", folder_ / "new.npz", key);
    EXPECT_EQ(first, 76U) << key;
    EXPECT_EQ(end, 105U) << key;
  }
  EXPECT_LT((Read("new.npz").frames[76].rotations - spin.frames[75].rotations).norm(), 1);
}

TEST_F(EditTest, ReportsThatNobodyWroteAreRefusedByTheirOwnNames) {
  const nlohmann::json report = ReadJson(folder_ / "report.json");
  const auto refused = [&](const nlohmann::json& changes, const std::string& message) {
    nlohmann::json edited = report;
    edited.update(changes);
    std::ofstream(folder_ / "edited.json") << edited;
    const Outcome outcome =
        Edit("--key kick --at 3 --report " + At("edited.json") + " -o " + At("new.npz"));
    EXPECT_EQ(outcome.code, 1) << message;
    EXPECT_THAT(outcome.said, HasSubstr("edited.json:" + message));
  };
  refused({{"music_beats", {1, 3, 2}}}, "music_beats[2]: 2 s is not after the beat before it, 3 s");
  refused({{"music_beats", {1, -2}}}, "music_beats[1]: -2 s is not within 0 to 600");
  refused({{"music_beats", {1, "2"}}}, "music_beats: ");
  refused({{"music_beats", {1, 2, 3}}, {"music_downbeats", {1, 2.5}}},
          "music_downbeats[1]: 2.5 s is not one of the beats");
  refused({{"music_downbeats", {1}}}, "music_downbeats[0]: 1 s is not one of the beats");
  refused({{"variation", 1.5}}, "variation: 1.5 is not in [0, 1]");
  refused({{"music_dynamics", -1}}, "music_dynamics: -1 is not in [0, 1]");
  refused({{"temperature", 3}}, "temperature: 3 is not in [0, 2]");
  refused({{"song_start", -1}}, "song_start: -1 is not in [0, 1e+09]");
  refused({{"seed", -1}}, "seed: -1 is not valid in a report");
  refused({{"seed", 1.5}}, "seed: 1.5 is not valid in a report");
  nlohmann::json keys = report["keyframes"];
  keys.push_back({{"id", "twin"}, {"frame", keys[1]["frame"]}});
  refused({{"keyframes", keys}}, "keyframes[" + std::to_string(keys.size() - 1) + "].frame: ");
}

TEST_F(EditTest, RefusesImpossibleEdits) {
  std::ofstream(folder_ / "other.json")
      << R"({"fps": 30.0, "keyframes": [{"id": "far", "frame": 900}]})";
  const auto expect_failure = [this](const std::string& arguments, const std::string& part) {
    const Outcome outcome = Edit(arguments + " -o " + At("new.npz"));
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_THAT(outcome.said, HasSubstr("choreo: "));
    EXPECT_THAT(outcome.said, HasSubstr(part));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "new.npz"));
  };
  expect_failure("", "--key: is missing, and so are --move, --remove");
  expect_failure("--key kick", "--at: 0 times for 1 keys");
  expect_failure("--key swan --at 1", "swan: is not a pose of the library");
  expect_failure("--key kick --at 3 --key groove --at 3.001",
                 "--key: kick and groove both ask for 3 s");
  for (const std::string around : {"1e300", "0.01", "60"}) {
    expect_failure("--key kick --at 5 --around " + around,
                   "s, must be 0.067 to 59.97 s: 2 to 1799 frames");
  }
  expect_failure("--key kick --at 11",
                 "11 s is after the dance, which has its last frame at 9.97 s");
  expect_failure(
      "--key kick --at 3 --key groove --at 3.03",
      "--at: 3.03 s lies 1 frame from the key at 3 s, must be at least 2 frames from it");
  expect_failure("--key kick --at 2 --report " + At("other.json"), "far stands at frame 900");
  std::ofstream(folder_ / "huge.json")
      << R"({"fps": 30.0, "keyframes": [{"id": "far", "frame": 18446744073709551615}]})";
  expect_failure(
      "--key kick --at 2 --report " + At("huge.json"),
      "keyframes[0]: has no id, or no frame that is a whole number from 0 to 1000000000");
  expect_failure("--key kick --at 2 --report " + At("dance.npz"),
                 "dance.npz: is not JSON, nor any text");
  std::ofstream(folder_ / "deep.json") << std::string(1'000'000, '[');
  expect_failure("--key kick --at 2 --report " + At("deep.json"), "more than 64 levels");
  expect_failure("--key kick --at 2 --report " + At("song.wav"), "is not JSON");
  expect_failure("--loop --new-report " + At("n.json"), "--new-report: needs --report");
  expect_failure("--key kick --at 2 --half-time",
                 "--beats: and other options of beats need a song");
}

}  // namespace choreo::edit_test
