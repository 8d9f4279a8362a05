#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "model/core/files/atomic_file.h"
#include "model/motion/kinematics/canonical.h"
#include "tests/client/edit_fixture.h"

/// What `choreo edit` takes from a dance's report, and which reports it refuses.
namespace choreo::edit_report_test {

using testing::HasSubstr;
using testing::Not;

const Skeleton& Body() { return Skeleton::Smpl24(); }

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

TEST_F(EditTest, TheReportHasTheFaultsOfTheNewDance) {
  ASSERT_EQ(Choreo("dance --seconds 9 --keyframes none" + Server() + "-o " + At("dance.npz") +
                   " --report " + At("report.json"))
                .code,
            0);
  for (const std::string edit : {"--key kick --at 6", "--until 5"}) {
    const Outcome outcome = Choreo("edit " + At("dance.npz") + " " + edit + " --report " +
                                   At("report.json") + " --new-report " + At("new.json") + " -o " +
                                   At("new.npz") + (edit == "--until 5" ? "" : Server()));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    const size_t faults = ReadJson(folder_ / "new.json")["faults"].size();
    const Outcome listed = Choreo("check --json " + At("new.npz"));
    EXPECT_EQ(nlohmann::json::parse(listed.said)["faults"].size(), faults);
    EXPECT_THAT(outcome.said, testing::ContainsRegex("(no faults|[0-9]+ faults?: .*lists them)\n"));
  }
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

}  // namespace choreo::edit_report_test
