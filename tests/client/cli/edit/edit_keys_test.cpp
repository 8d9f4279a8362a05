#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "model/core/files/atomic_file.h"
#include "model/motion/kinematics/canonical.h"
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

TEST_F(EditTest, AKeyBesideTheBeginningStandsOnTheFirstFrame) {
  const nlohmann::json keys = ReadJson(folder_ / "report.json")["keyframes"];
  ASSERT_EQ(keys[0]["frame"], 0);
  const std::string with_report =
      " --report " + At("report.json") + " --new-report " + At("new.json") + " -o " + At("new.npz");
  const Outcome set = Edit("--key dab --at 0.03" + with_report);
  ASSERT_EQ(set.code, 0) << set.said;
  EXPECT_THAT(set.said, HasSubstr("at 0 s makes way for \"dab\": it stands there"));
  EXPECT_THAT(set.said, HasSubstr("set key dab: frames 0 to"));
  const nlohmann::json now = ReadJson(folder_ / "new.json")["keyframes"];
  EXPECT_EQ(now[0]["id"], "dab");
  EXPECT_EQ(now[0]["frame"], 0);
  EXPECT_EQ(now.size(), keys.size());
  // Earlier dances may have such keys.
  nlohmann::json report = ReadJson(folder_ / "report.json");
  report["keyframes"][0]["frame"] = 1;
  std::ofstream(folder_ / "report.json") << report;
  const Outcome mirrored = Edit("--mirror-phrase 0 0.5" + with_report);
  ASSERT_EQ(mirrored.code, 0) << mirrored.said;
  EXPECT_EQ(ReadJson(folder_ / "new.json")["keyframes"][0]["frame"], 0);
}

TEST_F(EditTest, TheCountOfAKeyBesideTheBeginningStillNamesIt) {
  std::ofstream beats(folder_ / "beats.txt");
  for (int beat = 0; beat < 19; ++beat) beats << 0.03 + 0.5 * beat << '\n';
  beats.close();
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [
    {"id": "one", "time": "1c", "pose": "kick", "hold": "1c"}, {"time": "9c", "pose": "dab"}]})";
  ASSERT_EQ(Choreo("dance " + At("song.wav") + Server() + "--beats " + At("beats.txt") + " -k " +
                   At("keys.json") + " -o " + At("dance.npz") + " --report " + At("report.json"))
                .code,
            0);
  const nlohmann::json one = ReadJson(folder_ / "report.json")["keyframes"][0];
  EXPECT_EQ(one["frame"], 0);
  EXPECT_EQ(one["count"], 1);
  const Outcome outcome =
      Edit("--mirror-phrase 1c 2c --repeat 1c 2c 4c --report " + At("report.json") +
           " --new-report " + At("new.json") + " -o " + At("new.npz"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("mirrored key one: frames 0 to"));
  EXPECT_THAT(ReadJson(folder_ / "new.json")["keyframes"].dump(), HasSubstr(R"("count":5.0)"));
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

}  // namespace choreo::edit_keys_test
