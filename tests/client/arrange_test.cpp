#include "client/arrange.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/mirror.h"
#include "tests/client/stage_fixture.h"

/// `choreo edit` of whole dances and of phrases.
namespace choreo::arrange_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

double LargestAcceleration(const Motion& motion, size_t first, size_t last) {
  double largest = 0;
  for (size_t frame = first; frame <= last; ++frame) {
    const auto joints = [&](size_t at) { return JointPositions(Body(), motion.frames[at]); };
    const Eigen::Matrix3Xd second = joints(frame - 1) - 2 * joints(frame) + joints(frame + 1);
    largest = std::max(largest, second.colwise().norm().maxCoeff());
  }
  return largest;
}

void ExpectSame(const Pose& a, const Pose& b) {
  EXPECT_EQ(a.root_position, b.root_position);
  EXPECT_EQ(a.rotations, b.rotations);
}

std::string Seconds(int64_t frame) { return std::to_string(static_cast<double>(frame) / 30); }

class ArrangeTest : public StageTest {
 protected:
  void SetUp() override {
    StageTest::SetUp();
    const Outcome outcome = Dance("dance", "--seed 3");
    ASSERT_EQ(outcome.code, 0) << outcome.said;
  }
  /// Edits NAME.npz, by NAME.json, into OUT.npz and OUT.json.
  Outcome Edit(const std::string& name, const std::string& arguments, const std::string& out,
               const std::string& server = " --server 127.0.0.1:1 ") const {
    return Choreo("edit " + At(name + ".npz") + server + arguments + " --report " +
                  At(name + ".json") + " -o " + At(out + ".npz") + " --new-report " +
                  At(out + ".json"));
  }
  std::vector<int64_t> Keys(const std::string& name) const {
    std::vector<int64_t> frames;
    const nlohmann::json report = ReadJson(folder_ / (name + ".json"));
    for (const auto& key : report["keyframes"]) frames.push_back(key["frame"]);
    return frames;
  }
};

// None of these edits needs a server: the address has none.
TEST_F(ArrangeTest, PartsOfADanceMakeTheDance) {
  Outcome outcome = Edit("dance", "--until 4", "begin");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  outcome = Edit("dance", "--from 4", "end");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion whole = Read("dance.npz");
  EXPECT_EQ(Read("begin.npz").frames.size(), 120U);
  ASSERT_EQ(Read("end.npz").frames.size(), 180U);
  ExpectSame(Read("end.npz").frames[0], whole.frames[120]);
  for (const int64_t frame : Keys("begin")) EXPECT_LT(frame, 120);
  EXPECT_EQ(Keys("begin").size() + Keys("end").size(), Keys("dance").size());

  outcome = Edit("begin", "--gap 0 --join " + At("end.npz") + " --join-report " + At("end.json"),
                 "whole");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("joined as they are; the second begins at 4 s"));
  const Motion again = Read("whole.npz");
  ASSERT_EQ(again.frames.size(), whole.frames.size());
  for (size_t i = 0; i < whole.frames.size(); ++i) ExpectSame(again.frames[i], whole.frames[i]);
  EXPECT_EQ(Keys("whole"), Keys("dance"));
}

TEST_F(ArrangeTest, JoinsMatchingPartsDirectly) {
  ASSERT_EQ(Edit("dance", "--until 4", "begin").code, 0);
  ASSERT_EQ(Edit("dance", "--from " + std::to_string(119.0 / 30), "end").code, 0);
  const Outcome outcome =
      Edit("begin", "--join " + At("end.npz") + " --join-report " + At("end.json"), "whole");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("joined where they meet"));
  const Motion whole = Read("dance.npz"), again = Read("whole.npz");
  ASSERT_EQ(again.frames.size(), whole.frames.size());
  EXPECT_LT(ComparePoses(Body(), again.frames[250], whole.frames[250]).position_m, 1e-6);
  EXPECT_EQ(Keys("whole"), Keys("dance"));
}

TEST_F(ArrangeTest, AMirrorImageIsOneOfBodyAndStage) {
  const Outcome outcome = Edit("dance", "--mirror", "mirrored");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion mirrored = Read("mirrored.npz"), expected = Mirror(Body(), Read("dance.npz"));
  ASSERT_EQ(mirrored.frames.size(), expected.frames.size());
  for (size_t i = 0; i < expected.frames.size(); ++i) {
    EXPECT_LT(ComparePoses(Body(), mirrored.frames[i], expected.frames[i]).position_m, 1e-6);
  }
  EXPECT_EQ(Keys("mirrored"), Keys("dance"));
}

TEST_F(ArrangeTest, AMirrorImageKeepsTheNamesOfKeys) {
  nlohmann::json report = ReadJson(folder_ / "dance.json");
  report["keyframes"][0]["id"] = "left_kick";
  report["warnings"] = {
      {{"frame", 9}, {"message", "key \"left_kick\": left_knee and right_knee bend"}}};
  std::ofstream(folder_ / "named.json") << report;
  std::filesystem::copy(folder_ / "dance.npz", folder_ / "named.npz");
  const Outcome outcome = Edit("named", "--mirror", "mirrored");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_EQ(ReadJson(folder_ / "mirrored.json")["warnings"][0]["message"],
            "key \"left_kick\": right_knee and left_knee bend");
}

TEST_F(ArrangeTest, DancesTheTransitionToAnotherDance) {
  ASSERT_EQ(Dance("other", "--seed 8 --seconds 4").code, 0);
  const Outcome outcome = Edit("dance",
                               "--gap 0.8 --song " + At("song.wav") + " --join " + At("other.npz") +
                                   " --join-report " + At("other.json"),
                               "both", Server());
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("frames 300 to 322 are new; the second begins at 10.77 s"));
  const Motion first = Read("dance.npz"), second = Read("other.npz"), both = Read("both.npz");
  ASSERT_EQ(both.frames.size(), 300U + 23 + 120);
  for (size_t i = 0; i < 300; ++i) ExpectSame(both.frames[i], first.frames[i]);
  // The second begins where the first ends, and continues it.
  const GroundFrame end = GroundFrame::Of(first.frames.back());
  const GroundFrame begin = GroundFrame::Of(second.frames.front());
  for (const size_t i : {0, 60, 119}) {
    const Pose expected = end.ToWorld(begin.ToLocal(second.frames[i]));
    EXPECT_LT(ComparePoses(Body(), both.frames[323 + i], expected).position_m, 1e-6) << i;
  }
  EXPECT_LE(LargestAcceleration(both, 298, 325), 1.2 * LargestAcceleration(first, 1, 298));
  std::vector<int64_t> keys = Keys("dance");
  ASSERT_GE(keys.size(), 5U);
  for (const int64_t frame : Keys("other")) keys.push_back(frame + 323);
  EXPECT_EQ(Keys("both"), keys);
}

TEST_F(ArrangeTest, RepeatsAPhraseOnItsCounts) {
  const std::vector<int64_t> keys = Keys("dance");
  ASSERT_GE(keys.size(), 5U);
  // The keys of the second to the third, eight counts later: four seconds, as a count is half a
  // one.
  const Outcome outcome = Edit("dance",
                               "--song " + At("song.wav") + " --repeat " + Seconds(keys[1]) + ' ' +
                                   Seconds(keys[2] + 1) + " 8c",
                               "again", Server());
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion before = Read("dance.npz"), after = Read("again.npz");
  const GroundFrame there = GroundFrame::Of(before.frames[static_cast<size_t>(keys[1])]);
  const auto reported = ReadJson(folder_ / "again.json")["keyframes"];
  const auto original = ReadJson(folder_ / "dance.json")["keyframes"];
  GroundFrame here;
  for (size_t i = 1; i <= 2; ++i) {
    const auto again = std::ranges::find_if(reported, [&](const auto& key) {
      return key["id"] == original[i]["id"] && key["frame"].template get<int64_t>() != keys[i];
    });
    ASSERT_NE(again, reported.end());
    const int64_t frame = (*again)["frame"];
    EXPECT_NEAR(static_cast<double>(frame - keys[i]), 120, 2);
    const Pose& danced = after.frames[static_cast<size_t>(frame)];
    if (i == 1) here = GroundFrame::Of(before.frames[static_cast<size_t>(frame)]);
    const Pose expected = here.ToWorld(there.ToLocal(before.frames[static_cast<size_t>(keys[i])]));
    EXPECT_LE(ComparePoses(Body(), danced, expected).position_m, 0.001);
    EXPECT_LE(ComparePoses(Body(), danced, expected).angle_deg, 0.1);
  }
  // Keys in the phrase's place are removed, so only those before and after it stay.
  for (const auto& key : reported) {
    const int64_t frame = key["frame"];
    if (frame < keys[1] + 110 || frame > keys[2] + 110) continue;
    EXPECT_TRUE(key["id"] == original[1]["id"] || key["id"] == original[2]["id"]) << key;
  }
  ExpectSame(after.frames[static_cast<size_t>(keys[2])],
             before.frames[static_cast<size_t>(keys[2])]);
}

// A beat lasts 14.1 frames, so beats are rounded to frames: up, down, and up again after eight.
TEST_F(ArrangeTest, KeysThatCountsMoveAreOnTheirBeatsFrames) {
  const auto beat = [](int count) { return 0.251 + 0.47 * (count - 1); };
  const auto frame = [](double count) -> int64_t {
    return std::llround(30 * (0.251 + 0.47 * (count - 1)));
  };
  std::ofstream beats(folder_ / "beats.txt");
  for (int count = 1; beat(count) < 10; ++count)
    beats << beat(count) << ' ' << (count - 1) % 4 + 1 << '\n';
  beats.close();
  const std::string song = "--song " + At("song.wav") + " --beats " + At("beats.txt") + ' ';
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "one", "time": 0, "pose": "kick", "place": [0, 0]},
                           {"id": "two", "time": 1, "pose": "bow", "place": [0, 0]},
                           {"id": "three", "time": 2, "pose": "dab", "place": [0, 0]}]})";
  std::string set;
  for (const auto& [id, count] :
       {std::pair("one", "2c"), std::pair("two", "4c"), std::pair("three", "6.5c")})
    set += "--key " + At("keys.json") + '@' + id + " --at " + count + ' ';
  ASSERT_EQ(Edit("dance", song + set, "set", Server()).code, 0);
  const auto at = [this](const std::string& name, const std::string& id) {
    std::vector<int64_t> frames;
    const nlohmann::json report = ReadJson(folder_ / (name + ".json"));
    for (const auto& key : report["keyframes"])
      if (key["id"] == id) frames.push_back(key["frame"]);
    return frames;
  };
  for (const int later : {7, 8, 9, 10}) {
    ASSERT_EQ(
        Edit("set", song + "--repeat 2c 7c " + std::to_string(later) + 'c', "again", Server()).code,
        0);
    EXPECT_EQ(at("again", "one"), std::vector({frame(2), frame(2 + later)})) << later;
    EXPECT_EQ(at("again", "two"), std::vector({frame(4), frame(4 + later)})) << later;
    EXPECT_EQ(at("again", "three"), std::vector({frame(6.5), frame(6.5 + later)})) << later;
  }
  ASSERT_EQ(Edit("set", song + "--stretch 2c 7c 3", "slow", Server()).code, 0);
  EXPECT_EQ(at("slow", "two"), std::vector({frame(8)}));
  EXPECT_EQ(at("slow", "three"), std::vector({frame(15.5)}));
}

TEST_F(ArrangeTest, MirrorsAPhraseWhereTheDancerStands) {
  const std::vector<int64_t> keys = Keys("dance");
  ASSERT_GE(keys.size(), 5U);
  const Outcome outcome =
      Edit("dance", "--mirror-phrase " + Seconds(keys[1]) + ' ' + Seconds(keys[2] + 1), "mirrored",
           Server());
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_EQ(Keys("mirrored"), keys);
  const Motion before = Read("dance.npz"), after = Read("mirrored.npz");
  const auto at = [](const Motion& motion, int64_t frame) {
    return motion.frames[static_cast<size_t>(frame)];
  };
  const GroundFrame axis = GroundFrame::Of(at(before, keys[1]));
  for (size_t i = 1; i <= 2; ++i) {
    const Pose expected = axis.ToWorld(Mirror(Body(), axis.ToLocal(at(before, keys[i]))));
    EXPECT_LE(ComparePoses(Body(), at(after, keys[i]), expected).position_m, 0.001);
    EXPECT_GT(ComparePoses(Body(), at(after, keys[i]), at(before, keys[i])).position_m, 0.05);
  }
  ExpectSame(at(after, keys[0]), at(before, keys[0]));
  ExpectSame(at(after, keys[3]), at(before, keys[3]));
}

TEST_F(ArrangeTest, SaysWhatIsDoneToEachKey) {
  const std::vector<int64_t> keys = Keys("dance");
  const std::string id = ReadJson(folder_ / "dance.json")["keyframes"][1]["id"];
  const std::string phrase = Seconds(keys[1]) + ' ' + Seconds(keys[1] + 2);
  const Outcome outcome = Edit("dance",
                               "--repeat " + phrase + " 5 --mirror-phrase " +
                                   Seconds(keys[1] + 150) + ' ' + Seconds(keys[1] + 152),
                               "twice", Server());
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("\nrepeated key " + id + ": frames "));
  EXPECT_THAT(outcome.said, HasSubstr("\nmirrored key " + id + ": frames "));
}

TEST_F(ArrangeTest, APhraseGoesInHalfTime) {
  const std::vector<int64_t> keys = Keys("dance");
  ASSERT_GE(keys.size(), 5U);
  // The second of two keys comes twice as late.
  const std::string phrase = Seconds(keys[0]) + ' ' + Seconds(keys[1] + 1);
  const auto stretch = [&](const std::string& times, const std::string& name) {
    return Edit("dance", "--song " + At("song.wav") + " --stretch " + phrase + ' ' + times, name,
                Server());
  };
  const Outcome outcome = stretch("2", "half");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion before = Read("dance.npz"), half = Read("half.npz");
  ASSERT_EQ(half.frames.size(), before.frames.size());
  const std::vector<int64_t> after = Keys("half");
  EXPECT_EQ(after[0], keys[0]);
  EXPECT_NEAR(static_cast<double>(after[1]), static_cast<double>(2 * keys[1] - keys[0]), 1);
  EXPECT_LE(ComparePoses(Body(), half.frames[static_cast<size_t>(after[1])],
                         before.frames[static_cast<size_t>(keys[1])])
                .position_m,
            0.001);
  // The keys that stood there are gone, and everything after them is unchanged.
  const int64_t end = keys[0] + 2 * (keys[1] + 1 - keys[0]);
  std::vector<int64_t> expected = {keys[0], after[1]};
  std::ranges::copy_if(keys, std::back_inserter(expected),
                       [&](int64_t frame) { return frame >= end; });
  EXPECT_EQ(after, expected);
  EXPECT_LT(after.size(), keys.size());
  ASSERT_GE(expected.size(), 3U);
  for (auto frame = static_cast<size_t>(expected[2]); frame < before.frames.size(); ++frame)
    ExpectSame(half.frames[frame], before.frames[frame]);
  for (size_t frame = 0; frame <= static_cast<size_t>(keys[0]); ++frame)
    ExpectSame(half.frames[frame], before.frames[frame]);

  ASSERT_EQ(stretch("0.5", "double").code, 0);
  EXPECT_NEAR(static_cast<double>(Keys("double")[1]), static_cast<double>(keys[0] + keys[1]) / 2,
              1);
  EXPECT_EQ(Keys("double").size(), keys.size());

  // If a phrase begins before its first key, that key moves, too.
  ASSERT_GT(keys[1], 6);
  const Outcome later =
      Edit("dance", "--stretch " + Seconds(keys[1] - 6) + ' ' + Seconds(keys[2]) + " 0.5", "later",
           Server());
  ASSERT_EQ(later.code, 0) << later.said;
  EXPECT_EQ(Keys("later")[1], keys[1] - 3);
}

TEST_F(ArrangeTest, AHeldPoseIsHeldAsMuchLonger) {
  ASSERT_EQ(Edit("dance", "--key kick --at 3 --hold 0.6 --around 1", "held", Server()).code, 0);
  const auto held = [this](const std::string& name) {
    std::vector<int64_t> frames;
    const nlohmann::json report = ReadJson(folder_ / (name + ".json"));
    for (const auto& key : report["keyframes"])
      if (key.contains("holds")) frames.push_back(key["frame"]);
    return frames;
  };
  ASSERT_EQ(held("held").back(), 108);
  ASSERT_EQ(Edit("held", "--stretch 3 3.7 2", "longer", Server()).code, 0);
  EXPECT_NEAR(held("longer").back(), 126, 1);  // on the frame of a count
  EXPECT_EQ(held("longer").size(), 2 * held("held").size());
  const Motion motion = Read("longer.npz");
  for (size_t frame = 96; frame <= 126; frame += 6)
    EXPECT_LE(ComparePoses(Body(), motion.frames[frame], motion.frames[90]).position_m, 0.001);
}

// The hold covers frames 90 to 108, from 3 s to 3.6 s.
TEST_F(ArrangeTest, AHoldGoesWithItsKeyWhereverAPhraseIsCut) {
  ASSERT_EQ(Edit("dance", "--key kick --at 3 --hold 0.6 --around 1", "held", Server()).code, 0);
  const auto held = [this](const std::string& name) {
    std::vector<int64_t> frames;
    const nlohmann::json report = ReadJson(folder_ / (name + ".json"));
    for (const auto& key : report["keyframes"])
      if (key["id"] == "kick" || key.value("holds", "") == "kick") frames.push_back(key["frame"]);
    return frames;
  };
  const std::vector<int64_t> before = held("held");
  ASSERT_EQ(before.back(), 108);
  for (const std::string until : {"3.6", "3.3"}) {
    ASSERT_EQ(Edit("held", "--mirror-phrase 2.9 " + until, "sides", Server()).code, 0);
    EXPECT_EQ(held("sides"), before);
    const Motion sides = Read("sides.npz");
    for (size_t frame = 90; frame <= 108; frame += 6)
      EXPECT_LE(ComparePoses(Body(), sides.frames[frame], sides.frames[90]).position_m, 0.001);
    ASSERT_EQ(Edit("held", "--stretch 3 " + until + " 0.5", "shorter", Server()).code, 0);
    EXPECT_EQ(held("shorter").front(), 90);
    EXPECT_EQ(held("shorter").back(), 99);
    ASSERT_EQ(Edit("held", "--repeat 2.9 " + until + " 3", "twice", Server()).code, 0);
    const std::vector<int64_t> twice = held("twice");
    EXPECT_EQ(twice.size(), 2 * before.size());
    EXPECT_EQ(twice.back(), 198);
  }
  // The hold is the key's, and the key is not in this phrase.
  const Outcome outcome = Edit("held", "--mirror-phrase 3.1 3.7", "none", Server());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("no key from 3.1 s until 3.7 s: \"kick\" is held"));
}

TEST_F(ArrangeTest, HoldsAKey) {
  const Outcome outcome = Choreo("edit " + At("dance.npz") + Server() +
                                 "--key kick --at 5 --hold 0.6 --around 1 -o " + At("held.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion held = Read("held.npz");
  for (const size_t frame : {156, 162, 168}) {
    EXPECT_LE(ComparePoses(Body(), held.frames[frame], held.frames[150]).position_m, 0.001);
  }
  EXPECT_GT(ComparePoses(Body(), held.frames[180], held.frames[150]).position_m, 0.01);
}

TEST_F(ArrangeTest, AMovedKeyIsHeldAsLongAsAsked) {
  ASSERT_EQ(Edit("dance", "--key kick --at 3 --hold 0.6 --around 1", "held", Server()).code, 0);
  for (const auto& [hold, last] : {std::pair("1.2", 126), {"0.2", 96}}) {
    const Outcome outcome =
        Edit("held", std::string("--move kick 3 --hold ") + hold, "longer", Server());
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    int64_t until = 0;
    const nlohmann::json report = ReadJson(folder_ / "longer.json");
    for (const auto& key : report["keyframes"])
      if (key.value("holds", "") == "kick") until = key["frame"];
    EXPECT_EQ(until, last);
    const Motion motion = Read("longer.npz");
    for (int64_t frame = 90; frame <= last; frame += 6) {
      const auto& danced = motion.frames[static_cast<size_t>(frame)];
      EXPECT_LE(ComparePoses(Body(), danced, motion.frames[90]).position_m, 0.001);
    }
  }
}

TEST_F(ArrangeTest, AFilmThatIsAskedForBeyondTheEndSaysWhereThatIs) {
  const auto said = [&](const std::string& until) {
    return Choreo("render " + At("dance.npz") + " --frames 1 --from 9 --until " + until + " -o " +
                  At("sheet.png"))
        .said;
  };
  EXPECT_THAT(said("40"), HasSubstr("note: the motion ends at 10 s, before --until 40"));
  EXPECT_THAT(said("10"), testing::Not(HasSubstr("the motion ends")));
}

TEST_F(ArrangeTest, AFaultyKeyFileIsToldBeforeAServerIsStarted) {
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [{"time": 1, "pose": "star_jmp"}]})";
  const Outcome outcome =
      Choreo("dance --keyframes " + At("keys.json") + " -o " + At("faulty.npz"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("star_jump"));
  EXPECT_THAT(outcome.said, testing::Not(HasSubstr("a server is started")));
}

TEST_F(ArrangeTest, AHeldPoseStandsWhileItsPathWaits) {
  std::ofstream(folder_ / "path.json")
      << R"({"points": [{"time": 0, "x": 0, "z": 0}, {"time": 6, "x": 3, "z": 0}]})";
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "tree", "time": 2, "pose": "tree", "hold": 2}]})";
  const Outcome outcome = Choreo("dance" + Server() + "--keyframes " + At("keys.json") +
                                 " --path " + At("path.json") + " -o " + At("held.npz"));
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, testing::Not(HasSubstr("path")));
  const Motion dance = Read("held.npz");
  for (size_t frame = 60; frame <= 120; ++frame)
    EXPECT_NEAR(dance.frames[frame].root_position.x(), 1, 1e-3) << frame;
  EXPECT_NEAR(dance.frames.back().root_position.x(), 3, 0.02);
}

TEST_F(ArrangeTest, RefusesImpossibleArrangements) {
  const auto expect_failure = [this](const std::string& arguments, const std::string& part) {
    const Outcome outcome = Edit("dance", arguments, "new");
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_THAT(outcome.said, HasSubstr("choreo: " + part));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "new.npz"));
  };
  expect_failure("--mirror --key kick --at 2", "--key: and --move, --remove");
  expect_failure("--from 10", "--from: nothing of ");
  expect_failure("--from 9 --until 3", "--from: 9 s is not before --until, 3 s");
  expect_failure("--from 4 --until 4", "--from: 4 s is not before --until, 4 s");
  expect_failure("--until 0", "--until: nothing of ");
  expect_failure("--hold 1 --loop", "--hold: goes with --key");
  expect_failure("--join " + At("dance.npz"), "--join-report: is missing");
  const auto expect_late = [&](const std::string& arguments, const std::string& part) {
    const Outcome outcome = Edit("dance", arguments, "new", Server());
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_THAT(outcome.said, HasSubstr("choreo: " + part));
  };
  const std::string join = "--join " + At("dance.npz") + " --join-report " + At("dance.json");
  expect_late(join + " --gap 0.01", "--gap: 0.01 s, must be 0, or 0.067 to 60 s");
  expect_late("--song none --repeat 0 4 8c",
              "--repeat: 8c: counts need music that has beats; name a song");
  expect_late("--repeat 0 4 0", "--repeat: 0 is not later");
  expect_late("--repeat 0 4 soon", "--repeat: \"soon\" is neither seconds (2.5) nor counts (8c)");
  expect_late("--repeat 0.1 0.2 4", "--repeat: the report has no key from 0.1 s until 0.2 s");
  expect_late("--repeat 0 4 9", "--repeat: ");
  expect_failure("--stretch 0 4 5", "--stretch: 5 times, must be 0.25 to 4, and not 1");
  expect_late("--stretch 0.1 0.2 2", "--stretch: the report has no key from 0.1 s until 0.2 s");
}

TEST(ArrangeLibraryTest, KeepsContacts) {
  client::FinishedDance dance;
  dance.motion.frames.assign(60, RestPose(Body()));
  for (size_t i = 0; i < 60; ++i)
    dance.contacts.push_back({static_cast<float>(i), 1, static_cast<float>(100 + i), 2});
  const client::FinishedDance mirrored = client::Mirrored(Body(), dance);
  EXPECT_EQ(mirrored.contacts[7], (Contacts{107, 2, 7, 1}));
  EXPECT_EQ(client::PartOf(dance, 10, 20).contacts.front(), dance.contacts[10]);
  EXPECT_EQ(client::AtRate(dance, 15).contacts[5], dance.contacts[10]);
  EXPECT_EQ(client::Join(dance, mirrored).contacts[67], mirrored.contacts[7]);
}

}  // namespace choreo::arrange_test
