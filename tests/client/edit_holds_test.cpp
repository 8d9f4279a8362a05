#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "client/authoring/keys/pose_library.h"
#include "model/core/files/atomic_file.h"
#include "tests/client/edit_fixture.h"

/// Holds, hands and hits of keys that `choreo edit` sets and keeps.
namespace choreo::edit_holds_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

TEST_F(EditTest, AKeyInAHoldEndsIt) {
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "place": [0, 0], "hold": 3},
                           {"id": "b", "time": 7, "pose": "bow", "place": [0, 0]}]})";
  Outcome outcome = Choreo("dance -k " + At("keys.json") + Server() + "-o " + At("dance.npz") +
                           " --report " + At("report.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const auto held_to = [&](const char* report) {
    int64_t last = 0;
    const nlohmann::json read = ReadJson(folder_ / report);
    for (const auto& key : read["keyframes"])
      if (key.value("holds", "") == "a") last = std::max(last, key["frame"].get<int64_t>());
    return last;
  };
  EXPECT_EQ(held_to("report.json"), 120);
  const std::string reports = " --report " + At("report.json") + " --new-report " + At("new.json");
  outcome = Edit("--key kick --at 3 -o " + At("new.npz") + reports);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said,
              HasSubstr("warning: 3 s (frame 90): key \"a\" is held up to 2.4 s, not 4 s: "
                        "the key \"kick\" comes at 3 s"));
  EXPECT_EQ(held_to("new.json"), 72);
  EXPECT_EQ(ReadJson(folder_ / "new.json")["warnings"][0]["frame"], 90);
  outcome = Edit("--move b 2 -o " + At("new.npz") + reports);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("\"a\" is held up to 1.4 s, not 4 s: the key \"b\""));
  outcome = Edit("--key kick --at 1 -o " + At("new.npz") + reports);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said,
              HasSubstr("note: key \"a\" at 1 s makes way for \"kick\": it stands there\n"));
  EXPECT_EQ(held_to("new.json"), 0);
  // A key's hold is removed with it.
  outcome = Edit("--key kick --at 0.9 -o " + At("new.npz") + reports);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("\"a\" at 1 s makes way for \"kick\": it is less than"));
  EXPECT_EQ(held_to("new.json"), 0);
}

TEST_F(EditTest, KeysSayWhatHandsDo) {
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "place": [0, 0], "hands": "open"},
                           {"id": "b", "time": 3, "pose": "kick", "place": [0, 0]},
                           {"id": "c", "time": 5, "pose": "bow", "place": [0, 0], "hands": "fist",
                            "hold": 0.4}]})";
  Outcome outcome = Choreo("dance -k " + At("keys.json") + Server() + "-o " + At("dance.npz") +
                           " --report " + At("report.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const auto hands = [&](const std::string& report) {
    std::string said;
    const nlohmann::json read = ReadJson(folder_ / report);
    for (const auto& key : read["keyframes"]) said += key.value("hands", "-") + " ";
    return said;
  };
  EXPECT_EQ(hands("report.json"), "open - fist fist fist ");
  const std::string to =
      " --report " + At("report.json") + " --new-report " + At("new.json") + " -o " + At("new.npz");
  ASSERT_EQ(Edit("--move c 4 --key kick --at 2" + to).code, 0);
  EXPECT_EQ(hands("new.json"), "open - - fist fist fist ");
  ASSERT_EQ(Edit("--move b 2.5 --hands point" + to).code, 0);
  EXPECT_EQ(hands("new.json"), "open point fist fist fist ");
  outcome = Edit("--remove b --hands point" + to);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("--hands: goes with --key and --move"));
}

TEST_F(EditTest, KeysKeepHowTheyAreHit) {
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "place": [0, 0]},
                           {"id": "b", "time": 3, "pose": "kick", "place": [0, 0], "hit": 3},
                           {"id": "c", "time": 5, "pose": "bow", "place": [0, 0], "hold": 0.4}]})";
  const Outcome outcome = Choreo("dance -k " + At("keys.json") + Server() + "--seconds 12 -o " +
                                 At("dance.npz") + " --report " + At("report.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const auto hits = [&](const std::string& report) {
    std::string said;
    const nlohmann::json read = ReadJson(folder_ / report);
    for (const auto& key : read["keyframes"])
      said += key.contains("hit") ? key["hit"].dump() + " " : "- ";
    return said;
  };
  EXPECT_EQ(hits("report.json"), "- 3.0 1.0 - - ");
  const auto edited = [&](const std::string& edit) {
    const Outcome done = Edit(edit + " --report " + At("report.json") + " --new-report " +
                              At("new.json") + " -o " + At("new.npz"));
    EXPECT_EQ(done.code, 0) << done.said;
    return hits("new.json");
  };
  EXPECT_EQ(edited("--repeat 0.5 5.9 6"), "- 3.0 1.0 - - - 3.0 1.0 - - ");
  EXPECT_EQ(edited("--mirror-phrase 2 6"), "- 3.0 1.0 - - ");
  EXPECT_EQ(edited("--stretch 2 6 1.5"), "- 3.0 1.0 - - - ");
  EXPECT_EQ(edited("--key dab --at 2 --hit 0"), "- 0.0 3.0 1.0 - - ");
  EXPECT_EQ(edited("--remove c"), "- 3.0 ");
  EXPECT_EQ(edited("--move b 2.5 --hit 2"), "- 2.0 1.0 - - ");
  EXPECT_EQ(edited("--move b 2.5"), "- 3.0 1.0 - - ");

  // They are danced so, and so is the key after the edit.
  const std::string moved = ReadFile(folder_ / "new.npz");
  edited("--move b 2.5 --hit 3");
  EXPECT_EQ(ReadFile(folder_ / "new.npz"), moved);
  nlohmann::json report = ReadJson(folder_ / "report.json");
  const auto differs_without = [&](size_t key, const std::string& edit) {
    edited(edit);
    const std::string with = ReadFile(folder_ / "new.npz");
    nlohmann::json without = report;
    without["keyframes"][key].erase("hit");
    std::ofstream(folder_ / "report.json") << without.dump();
    edited(edit);
    std::ofstream(folder_ / "report.json") << report.dump();
    return ReadFile(folder_ / "new.npz") != with;
  };
  EXPECT_TRUE(differs_without(1, "--move b 2.5"));
  EXPECT_TRUE(differs_without(1, "--key dab --at 2"));
  EXPECT_TRUE(differs_without(1, "--remove a"));
  report["keyframes"][1]["hit"] = 4;
  std::ofstream(folder_ / "report.json") << report.dump();
  const Outcome wrong = Edit("--remove b --report " + At("report.json") + " -o " + At("new.npz"));
  EXPECT_EQ(wrong.code, 1);
  EXPECT_THAT(wrong.said, HasSubstr("report.json:keyframes[1].hit: 4 is not a number from 0"));
}

TEST_F(EditTest, LoopKeepsAHeldEnd) {
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "place": [0, 0]},
                           {"id": "b", "time": 3, "pose": "kick", "place": [0, 0], "hold": 0.4},
                           {"id": "end", "time": 5, "pose": "bow", "place": [0, 0], "hold": 1}]})";
  const std::string keys = "-k " + At("keys.json") + " --report " + At("report.json");
  Outcome outcome = Choreo("dance " + keys + Server() + "-o " + At("dance.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const std::string reports = " --report " + At("report.json") + " --new-report " + At("new.json");
  outcome = Edit("--loop -o " + At("loop.npz") + reports);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, testing::Not(HasSubstr("makes way")));
  const Motion before = Read("dance.npz");
  const Motion loop = Read("loop.npz");
  ASSERT_EQ(loop.frames.size(), before.frames.size() + 60);
  EXPECT_EQ(loop.frames[180].rotations, before.frames[180].rotations);
  EXPECT_LE(LargestAcceleration(loop, loop.frames.size() - 2, loop.frames.size()),
            1.2 * LargestAcceleration(before, 2, before.frames.size() - 3));
  const nlohmann::json looped = ReadJson(folder_ / "new.json");
  EXPECT_EQ(looped["frames"], loop.frames.size());
  EXPECT_EQ(looped["keyframes"].size(), 3U + 2 + 5);

  // A key's hold is removed with it.
  outcome = Edit("--move b 2.5 -o " + At("new.npz") + reports);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion moved = Read("new.npz");
  for (const size_t frame : {75, 81, 87}) {
    const Pose& pose = moved.frames[frame];
    EXPECT_LE(ComparePoses(Body(), pose, before.frames[frame + 15]).position_m, 0.001) << frame;
  }
  const nlohmann::json edited = ReadJson(folder_ / "new.json");
  EXPECT_EQ(edited["keyframes"][1]["frame"], 75);
  EXPECT_EQ(edited["keyframes"][3]["holds"], "b");
  EXPECT_EQ(edited["keyframes"][3]["frame"], 87);
  outcome = Edit("--move b 4.8 -o " + At("new.npz") + reports);
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("\"b\" is held up to 4.8 s, not 5.2 s: the key \"end\""));
}

TEST_F(EditTest, AFinishedDanceGetsAnEnding) {
  const Outcome outcome = Edit("--end bow --report " + At("report.json") + " -o " + At("new.npz") +
                               " --new-report " + At("new.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion motion = Read("new.npz");
  ASSERT_EQ(motion.frames.size(), 300U);
  PoseMask mask;
  mask.root_position = false;
  const Pose& bow = authoring::FindLibraryPose("bow").pose;
  for (const size_t frame : {285, 299})
    EXPECT_LT(ComparePoses(Body(), motion.frames[frame], bow, mask).angle_deg, 0.1) << frame;
  const nlohmann::json keys = ReadJson(folder_ / "new.json")["keyframes"];
  EXPECT_EQ(keys.back()["frame"], 299);
  EXPECT_EQ(keys.back()["holds"], "end-bow");
}

TEST_F(EditTest, AHoldEndsBeforeTheNextKeyAndLastsToTheEnd) {
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "place": [0, 0]},
                           {"id": "b", "time": 4, "pose": "kick", "place": [0, 0]}]})";
  Outcome outcome = Choreo("dance -k " + At("keys.json") + " --seconds 8" + Server() + "-o " +
                           At("dance.npz") + " --report " + At("report.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const auto held_to = [&](const std::string& arguments) {
    outcome = Edit(arguments + " -o " + At("new.npz") + " --report " + At("report.json") +
                   " --new-report " + At("new.json"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    int64_t last = 0;
    const nlohmann::json read = ReadJson(folder_ / "new.json");
    for (const auto& key : read["keyframes"])
      if (key.value("holds", "") == "bow") last = std::max(last, key["frame"].get<int64_t>());
    return last;
  };
  EXPECT_EQ(held_to("--key bow --at 2 --hold 3"), 105);
  EXPECT_THAT(outcome.said,
              HasSubstr("warning: 4 s (frame 120): key \"bow\" is held up to 3.5 s, not 5 "
                        "s: the key \"b\" comes at 4 s"));
  EXPECT_EQ(held_to("--key bow --at 5 --hold 1"), 180);
  for (const char* hold : {"1.8", "2", "2.5"}) {
    EXPECT_EQ(held_to(std::string("--key bow --at 6 --hold ") + hold), 239);
    const Motion motion = Read("new.npz");
    EXPECT_LE(ComparePoses(Body(), motion.frames[239], motion.frames[180]).angle_deg, 1);
  }
  EXPECT_THAT(outcome.said, HasSubstr("note: key \"bow\" is held to the end, 7.97 s, not 8.5 s"));
}

}  // namespace choreo::edit_holds_test
