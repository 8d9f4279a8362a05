#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "client/authoring/pose_library.h"
#include "model/core/atomic_file.h"
#include "model/motion/canonical.h"

#include "tests/client/edit_fixture.h"

/// Keys of a report that `choreo edit` moves, removes and keeps.
namespace choreo::edit_keys_test {

using testing::HasSubstr;
using testing::Not;

const Skeleton& Body() { return Skeleton::Smpl24(); }

TEST_F(EditTest, MovedKeyIsOnlyAtItsNewSecond) {
  const std::string id = ReadJson(folder_ / "report.json")["keyframes"][2]["id"];
  const std::string with_reports = "--report " + At("report.json") + " --new-report " +
                                   At("new.json") + " -o " + At("new.npz") + " --move '" + id;
  const size_t near = keys_[2] + 9;
  ASSERT_LT(near + 2, keys_[3]);
  Outcome outcome = Edit(with_reports + "' " + Seconds(near));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  ExpectChanged("new.npz", keys_[1] + 1, keys_[3]);
  const Motion before = Read("dance.npz");
  const auto off = [&](size_t frame) {
    return ComparePoses(Body(), Read("new.npz").frames[frame], before.frames[keys_[2]]).position_m;
  };
  EXPECT_LE(off(near), 0.001);
  EXPECT_GT(off(keys_[2]), 0.01);
  nlohmann::json keys = ReadJson(folder_ / "new.json")["keyframes"];
  ASSERT_EQ(keys.size(), keys_.size());
  EXPECT_EQ(keys[2]["id"], id);
  EXPECT_EQ(keys[2]["frame"], near);

  // If the key moves past its neighbour, the frames it leaves are danced again, too.
  outcome = Edit(with_reports + "' " + Seconds(keys_[3] + 9));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_LE(off(keys_[3] + 9), 0.001);
  EXPECT_GT(off(keys_[2]), 0.01);
  keys = ReadJson(folder_ / "new.json")["keyframes"];
  ASSERT_EQ(keys.size(), keys_.size());
  EXPECT_EQ(keys[2]["frame"], keys_[3]);
  EXPECT_EQ(keys[3]["id"], id);
}

TEST_F(EditTest, AKeyOfTheReportComesAgain) {
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [
    {"id": "mine", "time": 2, "pose": "dab", "place": [1, 0], "facing": 90, "hold": 1}]})";
  ASSERT_EQ(Choreo("dance --seconds 9 --keyframes " + At("keys.json") + Server() + "-o " +
                   At("dance.npz") + " --report " + At("report.json"))
                .code,
            0);
  for (const std::string id : {"mine", "mine@2"}) {
    const Outcome outcome = Edit("--key " + id + " --at 6 --report " + At("report.json") +
                                 " --new-report " + At("new.json") + " -o " + At("new.npz"));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("note: \"mine\" is the report's key at 2 s"));
    const Motion motion = Read("new.npz");
    const auto local = [&](size_t frame) {
      return GroundFrame::Of(motion.frames[frame]).ToLocal(motion.frames[frame]);
    };
    for (const size_t held : {0, 30})
      EXPECT_LE(ComparePoses(Body(), local(180 + held), local(60)).position_m, 0.002) << held;
    EXPECT_EQ(ReadJson(folder_ / "new.json")["keyframes"].back()["holds"], "mine");
  }
}

TEST_F(EditTest, ANewKeyStandsWhereItIsPut) {
  ASSERT_EQ(Choreo("pose --from dab --set left_elbow=90 --out " + At("own.json")).code, 0);
  for (const std::string& key : {At("own.json"), std::string("dab")}) {
    const Outcome outcome = Edit("--key " + key + " --at 3 --place -0.5,1 --facing 90 --report " +
                                 At("report.json") + " -o " + At("new.npz"));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    const GroundFrame there = GroundFrame::Of(Read("new.npz").frames[90]);
    EXPECT_LT((there.origin - Eigen::Vector3d(-0.5, 0, 1)).norm(), 0.1) << key;
    EXPECT_NEAR(there.heading, M_PI / 2, 0.3) << key;
  }
  EXPECT_THAT(
      Edit("--move a 3 --place 1,1 --report " + At("report.json") + " -o " + At("n.npz")).said,
      HasSubstr("--place: goes with --key"));
}

TEST_F(EditTest, TimesAreAlsoCountsOfTheMusic) {
  const nlohmann::json heard =
      nlohmann::json::parse(Choreo("analyze --json " + At("song.wav")).said);
  const double one = heard["downbeats"][0];
  const auto with = [&](const std::string& edit) {
    return Edit(edit + " --song " + At("song.wav") + " --report " + At("report.json") + " -o " +
                At("new.npz"));
  };
  const auto expect_same = [&](const std::string& counts, const std::string& seconds) {
    ASSERT_EQ(with(seconds).code, 0) << seconds;
    std::filesystem::rename(folder_ / "new.npz", folder_ / "seconds.npz");
    const Outcome outcome = with(counts);
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    EXPECT_EQ(ReadFile(folder_ / "new.npz"), ReadFile(folder_ / "seconds.npz"));
  };
  const auto at = [&](double beats) { return std::to_string(one + 0.5 * beats); };
  expect_same("--key kick --at 9c --hold 2c", "--key kick --at " + at(8) + " --hold 1");
  expect_same("--from 2.5c --until 9c", "--from " + at(1.5) + " --until " + at(8));
  const Outcome without = Edit("--key kick --at 9c -o " + At("new.npz"));
  EXPECT_EQ(without.code, 1);
  EXPECT_THAT(without.said, HasSubstr("--at: 9c: counts need music that has beats; name a song"));
}

// The report's beats may already be halved.
TEST_F(EditTest, TheReportsBeatsAreCountedAsAskedOrRefused) {
  std::ofstream(folder_ / "beats.txt") << "1\n2\n3\n4\n5\n6\n7\n8\n9\n";
  const std::string given = " --song " + At("song.wav") + " --beats " + At("beats.txt");
  ASSERT_EQ(Choreo("dance " + At("song.wav") + Server() + "--beats " + At("beats.txt") + " -o " +
                   At("dance.npz") + " --report " + At("report.json"))
                .code,
            0);
  const auto edit = [&](const std::string& options) {
    const Outcome outcome = Edit("--key kick --at 3c --report " + At("report.json") + " -o " +
                                 At("new.npz") + " --new-report " + At("new.json") + options);
    if (outcome.code != 0) return outcome.said;
    for (const nlohmann::json report = ReadJson(folder_ / "new.json");
         const auto& key : report["keyframes"]) {
      if (key["id"] == "kick") return key["frame"].dump();
    }
    return std::string("no key");
  };
  EXPECT_EQ(edit(""), "90") << "the third of them";
  EXPECT_EQ(edit(" --downbeat 2"), "120") << "the third from there";
  EXPECT_EQ(edit(given + " --half-time"), "150");
  for (const std::string option : {"--half-time", "--double-time"}) {
    EXPECT_THAT(edit(" " + option), HasSubstr(option + ": "));
    EXPECT_THAT(edit(" " + option),
                HasSubstr("choose which beats to change: --beats auto, or --beats FILE"));
  }
}

TEST_F(EditTest, NewFramesAreDancedAsTheReportSays) {
  const auto edit = [&](const std::string& options) {
    const Outcome outcome =
        Edit("--key kick --at 3 --report " + At("report.json") + " --new-report " + At("new.json") +
             " -o " + At("new.npz") + options);
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return outcome.said;
  };
  const std::string said = edit("");
  EXPECT_THAT(said, HasSubstr("note: as " + (folder_ / "report.json").string() + " says: song " +
                              (folder_ / "song.wav").string() + ", model "));
  EXPECT_THAT(said, HasSubstr(", seed 3\n"));
  const std::string as_before = ReadFile(folder_ / "new.npz");
  const nlohmann::json report = ReadJson(folder_ / "new.json");
  EXPECT_EQ(report["seed"], 3) << "for the next edit";
  EXPECT_EQ(report["song"], (folder_ / "song.wav").string());
  EXPECT_THAT(edit(" --seed 3 --song " + At("song.wav")), Not(HasSubstr(", seed")));
  EXPECT_EQ(ReadFile(folder_ / "new.npz"), as_before);
  EXPECT_THAT(edit(" --song none"), Not(HasSubstr("song.wav")));
  EXPECT_NE(ReadFile(folder_ / "new.npz"), as_before);

  // A part of a dance begins later in the song.
  ASSERT_EQ(Edit("--from 2 --report " + At("report.json") + " --new-report " + At("new.json") +
                 " -o " + At("new.npz"))
                .code,
            0);
  EXPECT_EQ(ReadJson(folder_ / "new.json")["song_start"], 2);

  // A song that moved together with its report is found. Otherwise the command says that it is not.
  std::filesystem::create_directory(folder_ / "other");
  std::filesystem::rename(folder_ / "song.wav", folder_ / "other" / "song.wav");
  EXPECT_THAT(edit(""), HasSubstr("song.wav, the song of "));
}

TEST_F(EditTest, KeysTooNearANewOneMakeWayAndAreNamed) {
  const std::string id = ReadJson(folder_ / "report.json")["keyframes"][2]["id"];
  const Outcome outcome = Edit("--key kick --at " + Seconds(keys_[2] + 3) + " --key dab --at " +
                               Seconds(keys_[2] + 6) + " --report " + At("report.json") +
                               " --new-report " + At("new.json") + " -o " + At("new.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("note: key \"" + id + "\" at"));
  EXPECT_THAT(outcome.said, HasSubstr("makes way for \"kick\""));
  const nlohmann::json report = ReadJson(folder_ / "new.json");
  std::vector<std::string> ids;
  for (const auto& key : report["keyframes"]) ids.push_back(key["id"]);
  EXPECT_EQ(ids.size(), keys_.size() + 1);
  EXPECT_THAT(ids, testing::Not(testing::Contains(id)));
  EXPECT_THAT(ids, testing::IsSupersetOf({"kick", "dab"})) << "new keys keep each other";
}

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

TEST_F(EditTest, AKeyThatLandsOnAnotherSaysWhichOneItReplaces) {
  const nlohmann::json keys = ReadJson(folder_ / "report.json")["keyframes"];
  const std::string moved = keys[1]["id"], replaced = keys[2]["id"];
  const std::string with_report =
      " --report " + At("report.json") + " --new-report " + At("new.json") + " -o " + At("new.npz");
  const std::string there = Seconds(keys_[2]);
  const auto note = [&](const std::string& by) {
    return testing::ContainsRegex("note: key \"" + replaced + "\" at [0-9.]+ s makes way for \"" +
                                  by + "\": it stands there");
  };
  Outcome outcome = Edit("--move '" + moved + "' " + there + with_report);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, note(moved));
  EXPECT_EQ(ReadJson(folder_ / "new.json")["keyframes"].size(), keys_.size() - 1);
  outcome = Edit("--key kick --at " + there + with_report);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, note("kick"));
  // One command cannot set two keys there.
  outcome = Edit("--key kick --at " + there + " --move '" + moved + "' " + there + with_report);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("s for \"kick\" is where this edit sets \"" + moved + "\""));
}

// An edit must not change what nobody asked it to change.
TEST_F(EditTest, AKeyInAFreeDanceChangesTwoSecondsOnEachSide) {
  ASSERT_EQ(Choreo("dance -k none" + Server() + "--seconds 20 -o " + At("dance.npz") +
                   " --report " + At("report.json"))
                .code,
            0);
  const auto edit = [&](const std::string& arguments, const std::string& from,
                        const std::string& to) {
    const Outcome outcome =
        Choreo("edit " + At(from + ".npz") + Server() + arguments + " --report " +
               At((from == "dance" ? "report" : from) + ".json") + " -o " + At(to + ".npz") +
               " --new-report " + At(to + ".json"));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
  };
  edit("--key kick --at 5", "dance", "kick");
  ExpectChanged("kick.npz", 91, 210);
  edit("--remove kick", "kick", "none");
  ExpectChanged("none.npz", 91, 210);
  // At its old place and at its new one.
  edit("--move kick 15", "kick", "moved");
  const auto rows = ChangedRows(folder_ / "kick.npz", folder_ / "moved.npz", "rotations");
  EXPECT_EQ(rows, std::pair(size_t{91}, size_t{510}));
  const Motion before = Read("kick.npz"), moved = Read("moved.npz");
  for (size_t frame = 210; frame <= 390; ++frame)
    EXPECT_EQ(moved.frames[frame].rotations, before.frames[frame].rotations) << frame;
  // The edit ends at the next key if it is near enough.
  edit("--key dab --at 8.5", "kick", "both");
  EXPECT_EQ(ChangedRows(folder_ / "kick.npz", folder_ / "both.npz", "rotations"),
            std::pair(size_t{151}, size_t{315}));
  // A shortened hold is danced again up to its former end.
  edit("--key stand --at 5 --hold 8", "dance", "held");
  edit("--key dab --at 7", "held", "ended");
  EXPECT_EQ(ChangedRows(folder_ / "held.npz", folder_ / "ended.npz", "rotations").second, 450U);
}

TEST_F(EditTest, KeysInTheWayOfAPhraseAreNamed) {
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "place": [0, 0]},
                           {"id": "b", "time": 2, "pose": "kick", "place": [0, 0]},
                           {"id": "c", "time": 3, "pose": "bow", "place": [0, 0], "hold": 0.4},
                           {"id": "d", "time": 6, "pose": "dab", "place": [0, 0]}]})";
  Outcome outcome = Choreo("dance -k " + At("keys.json") + Server() + "-o " + At("dance.npz") +
                           " --report " + At("report.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const std::string report = " --report " + At("report.json") + " -o " + At("new.npz");
  outcome = Edit("--repeat 0.5 2.5 2" + report);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("note: key \"c\" at 3 s makes way for repeated keys\n"));
  EXPECT_THAT(outcome.said,
              Not(testing::ContainsRegex("\"[abd]\" at . s makes way|3\\.. s makes")));
  outcome = Edit("--stretch 0.5 2.5 2" + report);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("note: key \"c\" at 3 s makes way for stretched keys\n"));
  EXPECT_THAT(outcome.said,
              Not(testing::ContainsRegex("\"[abd]\" at . s makes way|3\\.. s makes")));
}

// The other dance has the same length.
TEST_F(EditTest, TheReportOfADanceThatLooksOtherwiseIsRefused) {
  const auto dance = [&](const std::string& pose, const std::string& name) {
    std::ofstream(folder_ / "keys.json")
        << R"({"keyframes": [)"
           R"({"id": "a", "time": 0, "place": [0, 0], "hold": 4, "pose": ")"
        << pose << "\"}]}";
    return Choreo("dance -k " + At("keys.json") + Server() + "-o " + At(name + ".npz") +
                  " --report " + At(name + ".json") + " --seconds 5")
        .code;
  };
  ASSERT_EQ(dance("stand", "dance"), 0);
  ASSERT_EQ(dance("crouch", "other"), 0);
  Outcome outcome = Edit("--key kick --at 4.5 --report " + At("other.json") + " -o " + At("n.npz"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said,
              HasSubstr("other.json: is the report of another dance, which differs "));
  const std::string render = "render " + At("dance.npz") + " --out " + At("s.png") + " --report ";
  outcome = Choreo(render + At("other.json"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said,
              HasSubstr("other.json: is the report of another dance, which differs "));
  outcome = Choreo(render + At("dance.json"));
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, Not(HasSubstr("looks otherwise")));
  // Reports of any format, rate and earlier version are accepted.
  ASSERT_EQ(Choreo("convert " + At("dance.npz") + " " + At("dance.bvh")).code, 0);
  outcome = Choreo("edit " + At("dance.bvh") + Server() + "--key kick --at 4.5 --report " +
                   At("dance.json") + " -o " + At("n.npz"));
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, Not(HasSubstr("looks otherwise")));
  nlohmann::json old = ReadJson(folder_ / "other.json");
  old.erase("motion_sketch");
  std::ofstream(folder_ / "old.json") << old.dump();
  outcome = Edit("--key kick --at 4.5 --report " + At("old.json") + " -o " + At("n.npz"));
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  // The report lacks what other edits have set.
  outcome = Choreo("edit " + At("n.npz") + Server() + "--key bow --at 2 --report " +
                   At("dance.json") + " --new-report " + At("new.json") + " -o " + At("m.npz"));
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("note: the dance differs from "));
  outcome = Choreo("edit " + At("m.npz") + Server() + "--key dab --at 2.5 --report " +
                   At("new.json") + " -o " + At("o.npz"));
  EXPECT_THAT(outcome.said, Not(HasSubstr("looks otherwise")));
}

TEST_F(EditTest, WithoutAReportAnEditSaysWhatItDoesNotKnow) {
  const std::string key = "--key kick --at 4 -o " + At("n.npz");
  EXPECT_THAT(
      Edit(key).said,
      HasSubstr("note: without --report the dance's keys and song are not known: new frames "
                "follow no music, and keys near an edit are danced over\n"));
  EXPECT_THAT(Edit(key + " --song " + At("song.wav")).said,
              HasSubstr("note: without --report the dance's keys are not known: keys near an edit "
                        "are danced over\n"));
  EXPECT_THAT(Edit(key + " --report " + At("report.json")).said,
              Not(HasSubstr("without --report")));
}

TEST_F(EditTest, AnotherDancesReportIsRefused) {
  nlohmann::json report = ReadJson(folder_ / "report.json");
  report["frames"] = report["frames"].get<int>() + 30;
  std::ofstream(folder_ / "other.json") << report.dump();
  const Outcome outcome =
      Edit("--key kick --at 3 --report " + At("other.json") + " -o " + At("new.npz"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("other.json:frames: "));
  EXPECT_THAT(outcome.said, HasSubstr("another dance's report"));
}

TEST_F(EditTest, ADanceAtAnotherRateIsEditedByItsReport) {
  for (const std::string fps : {"24", "25", "50", "12"}) {
    SCOPED_TRACE(fps);
    Outcome outcome = Choreo("dance " + At("song.wav") + Server() + "--fps " + fps + " -o " +
                             At("rate.bvh") + " --report " + At("rate.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    nlohmann::json report = ReadJson(folder_ / "rate.json");
    auto& last = report["keyframes"].back();
    last["frame"] = report["frames"].get<int>() - 1;
    std::ofstream(folder_ / "rate.json") << report.dump();
    const std::string edit = "edit " + At("rate.bvh") + Server() + "-o " + At("new.bvh") +
                             " --new-report " + At("new.json");
    outcome = Choreo(edit + " --key kick --at 3 --report " + At("rate.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    const nlohmann::json edited = ReadJson(folder_ / "new.json");
    EXPECT_EQ(edited["keyframes"].back()["id"], last["id"]);
    EXPECT_EQ(edited["keyframes"].back()["frame"], edited["frames"].get<int>() - 1);
    outcome = Choreo(edit + " --from 1 --report " + At("rate.json"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    report["frames"] = report["frames"].get<int>() + 3;
    std::ofstream(folder_ / "rate.json") << report.dump();
    outcome = Choreo(edit + " --key kick --at 3 --report " + At("rate.json"));
    EXPECT_THAT(outcome.said, HasSubstr("another dance's report"));
  }
}

TEST_F(EditTest, ARemovedKeyIsDancedPast) {
  const nlohmann::json keys = ReadJson(folder_ / "report.json")["keyframes"];
  const auto remove = [&](size_t index) {
    return Edit("--remove '" + keys[index]["id"].get<std::string>() + "' --report " +
                At("report.json") + " --new-report " + At("new.json") + " -o " + At("new.npz"));
  };
  Outcome outcome = remove(2);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  ExpectChanged("new.npz", keys_[1] + 1, keys_[3]);
  EXPECT_EQ(ReadJson(folder_ / "new.json")["keyframes"].size(), keys_.size() - 1);
  const Pose there = Read("new.npz").frames[keys_[2]];
  EXPECT_GT(ComparePoses(Body(), there, Read("dance.npz").frames[keys_[2]]).position_m, 0.01);

  outcome = Edit("--remove nosuch --report " + At("report.json") + " -o " + At("other.npz"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("--remove: the report has no key \"nosuch\"; it has " +
                                      keys[0]["id"].get<std::string>()));
  EXPECT_THAT(outcome.said, HasSubstr(" (after an edit, --new-report lists its keys)\n"));
  const std::string first = keys[0]["id"].get<std::string>();
  const std::string begun = first.substr(0, first.size() - 1);
  outcome = Edit("--remove '" + begun + "' --report " + At("report.json") + " -o " + At("o.npz"));
  EXPECT_THAT(outcome.said, HasSubstr("no key \"" + begun + "\"; did you mean " + first + "?"));
  outcome = Choreo("edit " + At("dance.npz") + " --server 127.0.0.1:1 --remove nosuch --report " +
                   At("report.json") + " -o " + At("other.npz"));
  EXPECT_THAT(outcome.said, HasSubstr("--remove: the report has no key")) << "without a server";
  outcome = Edit("--move nosuch 3 -o " + At("other.npz"));
  EXPECT_THAT(outcome.said, HasSubstr("--move: needs --report"));
}

TEST_F(EditTest, OneOfSeveralKeysOfANameIsTheNearest) {
  nlohmann::json report = ReadJson(folder_ / "report.json");
  for (auto& key : report["keyframes"]) key["id"] = "same";
  std::ofstream(folder_ / "report.json") << report.dump();
  const double one =
      nlohmann::json::parse(Choreo("analyze --json " + At("song.wav")).said)["downbeats"][0];
  // A count lasts half a second.
  const auto count = [&](double second) { return std::to_string(1 + (second - one) * 2) + "c"; };
  const auto remove = [&](const std::string& time) {
    return Edit("--remove same@" + time + " --report " + At("report.json") + " --new-report " +
                At("new.json") + " -o " + At("new.npz"));
  };
  const double second = static_cast<double>(keys_[2]) / 30;
  for (const std::string& time : {Seconds(keys_[2]), std::to_string(second + 0.12),
                                  std::to_string(second - 0.12), count(second + 0.2)}) {
    SCOPED_TRACE(time);
    const Outcome outcome = remove(time);
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    std::vector<size_t> left;
    for (const nlohmann::json edited = ReadJson(folder_ / "new.json");
         const auto& key : edited["keyframes"]) {
      left.push_back(key["frame"]);
    }
    std::vector<size_t> expected = keys_;
    expected.erase(expected.begin() + 2);
    EXPECT_EQ(left, expected);
  }
  for (const std::string& time : {std::to_string(second + 0.24), count(second + 0.3)}) {
    const Outcome outcome = remove(time);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.said, HasSubstr("--remove: the report has no key \"same@" + time));
    EXPECT_THAT(outcome.said, HasSubstr("; it has \"same\" at "));
  }
  EXPECT_THAT(remove("soon").said, HasSubstr("--remove: "));
  EXPECT_THAT(remove("9c --song none").said, HasSubstr("counts need music"));
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

}  // namespace choreo::edit_keys_test
