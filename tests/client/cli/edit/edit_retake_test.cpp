#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "model/core/files/atomic_file.h"
#include "tests/client/edit_fixture.h"

namespace choreo::edit_retake_test {

using testing::HasSubstr;

class RetakeTest : public EditTest {
 protected:
  std::string Report(const std::string& name) const {
    return " --report " + At("report.json") + " -o " + At(name + ".npz") + " --new-report " +
           At(name + ".json") + " ";
  }
};

TEST_F(RetakeTest, AnotherTakeKeepsItsKeysAndWhatIsAround) {
  const std::string stretch = "--retake " + Seconds(keys_[1]) + " " + Seconds(keys_[3] + 5);
  const Outcome outcome = Edit(stretch + Report("take"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("note: retakes use seed 4; another --seed gives"));
  ExpectChanged("take.npz", keys_[1] + 1, keys_[3] + 5);
  const Motion before = Read("dance.npz");
  const Motion after = Read("take.npz");
  for (const size_t key : {keys_[2], keys_[3]}) {
    const PoseError error = ComparePoses(Skeleton::Smpl24(), after.frames[key], before.frames[key]);
    EXPECT_LE(error.position_m, 0.001);
    EXPECT_LE(error.angle_deg, 0.1);
  }
  const auto keys = [&](const char* report) {
    std::vector<std::pair<std::string, int>> named;
    const nlohmann::json read = ReadJson(folder_ / report);
    for (const auto& key : read["keyframes"]) named.emplace_back(key["id"], key["frame"]);
    return named;
  };
  EXPECT_EQ(keys("take.json"), keys("report.json"));

  ASSERT_EQ(Edit(stretch + " --seed 4" + Report("same")).code, 0);
  EXPECT_EQ(ReadFile(folder_ / "same.npz"), ReadFile(folder_ / "take.npz"));
  ASSERT_EQ(Edit(stretch + " --seed 5" + Report("other")).code, 0);
  EXPECT_NE(ReadFile(folder_ / "other.npz"), ReadFile(folder_ / "take.npz"));
  const Outcome next = Choreo("edit " + At("take.npz") + Server() + stretch + " --report " +
                              At("take.json") + " -o " + At("next.npz"));
  ASSERT_EQ(next.code, 0) << next.said;
  EXPECT_THAT(next.said, HasSubstr("note: retakes use seed 5; another"));
  EXPECT_EQ(ReadJson(folder_ / "take.json")["seed"], 3) << "the dance's";
  EXPECT_NE(ReadFile(folder_ / "next.npz"), ReadFile(folder_ / "take.npz"));
}

TEST_F(RetakeTest, ATakeMayReachTheEndAndKeepsHolds) {
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "place": [0, 0], "hold": 1,
                            "hit": 2, "hands": "fist"}]})";
  ASSERT_EQ(Choreo("dance -k " + At("keys.json") + Server() + "--seconds 5 -o " + At("dance.npz") +
                   " --report " + At("report.json"))
                .code,
            0);
  const Outcome outcome = Edit("--retake 0 5" + Report("take"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_EQ(Read("take.npz").frames.size(), 150U);
  const nlohmann::json before = ReadJson(folder_ / "report.json")["keyframes"];
  const nlohmann::json after = ReadJson(folder_ / "take.json")["keyframes"];
  ASSERT_EQ(after.size(), before.size());
  for (size_t i = 0; i < before.size(); ++i)
    for (const char* mark : {"id", "frame", "holds", "hit", "hands"})
      EXPECT_EQ(after[i].value(mark, nlohmann::json()), before[i].value(mark, nlohmann::json()));
}

TEST_F(RetakeTest, RefusesWhatIsNoStretch) {
  const auto refused = [&](const std::string& stretch, const std::string& message) {
    const Outcome outcome = Edit("--retake " + stretch + Report("take"));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.said, HasSubstr(message));
  };
  refused("3 2", "--retake: 2 is not after 3");
  refused("3 3.05", "--retake: 3 s to 3.05 s leaves no room in the dance");
  refused("1 40", "--retake: 40 s is after the dance");
  const Outcome brief = Edit("--retake 3 3.3" + Report("take"));
  EXPECT_EQ(brief.code, 0) << brief.said;
  EXPECT_THAT(brief.said, HasSubstr("in less than 0.5 s nothing much can change"));
  refused("30 40", "--retake: 30 s is after the dance");
}

// A model's transition lasts at most a minute.
TEST_F(RetakeTest, ATakeMayBeLongerThanATransition) {
  ASSERT_EQ(Choreo("dance -k none" + Server() + "--seconds 65 -o " + At("dance.npz") +
                   " --report " + At("report.json"))
                .code,
            0);
  const Outcome outcome = Edit("--retake 1 64.5" + Report("take"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  ExpectChanged("take.npz", 31, 1935);
}

TEST_F(RetakeTest, TheWholeDanceIsDancedAnewAsAsked) {
  ASSERT_EQ(Edit("--seed 5" + Report("other")).code, 0);
  const Motion before = Read("dance.npz");
  const Motion other = Read("other.npz");
  EXPECT_NE(ReadFile(folder_ / "other.npz"), ReadFile(folder_ / "dance.npz"));
  for (const size_t key : keys_) {
    EXPECT_LE(ComparePoses(Skeleton::Smpl24(), other.frames[key], before.frames[key]).position_m,
              0.001);
  }
  EXPECT_EQ(ReadJson(folder_ / "other.json")["seed"], 5) << "for the next edit";

  const Outcome without = Edit("--style sad -o " + At("new.npz"));
  EXPECT_EQ(without.code, 1);
  EXPECT_THAT(without.said, HasSubstr("--report: is missing"));
}

TEST_F(RetakeTest, OtherBeatsAloneAreDancedToAnew) {
  const auto beats = [&](const std::string& report, const char* member = "music_beats") {
    return ReadJson(folder_ / report).value(member, std::vector<double>());
  };
  const Outcome half = Edit("--half-time" + Report("half"));
  ASSERT_EQ(half.code, 0) << half.said;
  EXPECT_THAT(half.said, HasSubstr("note: to other beats all frames are danced anew, through the "
                                   "same keys at the same seconds"));
  EXPECT_NE(ReadFile(folder_ / "half.npz"), ReadFile(folder_ / "dance.npz"));
  const std::vector<double> halved = beats("half.json");
  ASSERT_GE(halved.size(), 8U);
  EXPECT_NEAR(halved[5] - halved[4], 1, 0.03);
  const Motion before = Read("dance.npz"), after = Read("half.npz");
  for (const size_t key : keys_) {
    EXPECT_LE(ComparePoses(Skeleton::Smpl24(), after.frames[key], before.frames[key]).position_m,
              0.001);
  }

  const auto edit = [&](const std::string& options) {
    const Outcome outcome =
        Choreo("edit " + At("half.npz") + Server() + options + " --report " + At("half.json") +
               " -o " + At("new.npz") + " --new-report " + At("new.json"));
    EXPECT_EQ(outcome.code, 0) << outcome.said;
    return outcome.said;
  };
  EXPECT_THAT(edit("--downbeat " + std::to_string(halved[2])),
              HasSubstr("note: --downbeat alone renames counts; all frames and keys stay"));
  EXPECT_EQ(ReadFile(folder_ / "new.npz"), ReadFile(folder_ / "half.npz"));
  EXPECT_EQ(beats("new.json"), halved);
  EXPECT_EQ(beats("new.json", "music_downbeats").front(), halved[2]);
  edit("--double-time");
  EXPECT_NEAR(beats("new.json")[9] - beats("new.json")[8], 0.5, 0.03) << "of the report's";
  edit("--beats auto");
  EXPECT_TRUE(beats("new.json").empty()) << "those found in the song";
  edit("--tempo 120 --music-dynamics 0.3");
  EXPECT_GE(beats("new.json").size(), 16U);

  const Outcome missing =
      Edit("--downbeat 2 --report " + At("report.json") + " -o " + At("new.npz"));
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.said, HasSubstr("--new-report: is missing: --downbeat alone changes only"));
}

TEST_F(RetakeTest, AFreeDanceDancedAnewIsTheOneBeforeItsEdits) {
  ASSERT_EQ(Choreo("dance " + At("song.wav") + Server() + "-k none --seed 3 -o " + At("dance.npz") +
                   " --report " + At("report.json"))
                .code,
            0);
  const std::string free = ReadFile(folder_ / "dance.npz");
  ASSERT_EQ(Edit("--key kick --at 4" + Report("kick")).code, 0);
  const auto edit = [&](const std::string& name, const std::string& arguments) {
    return Choreo("edit " + At(name + ".npz") + Server() + arguments + " --report " +
                  At(name + ".json") + " -o " + At("new.npz") + " --new-report " + At("new.json"))
        .code;
  };
  ASSERT_EQ(edit("kick", "--remove kick"), 0);
  EXPECT_NE(ReadFile(folder_ / "new.npz"), free) << "its two intervals alone are danced anew";
  std::filesystem::rename(folder_ / "new.npz", folder_ / "none.npz");
  std::filesystem::rename(folder_ / "new.json", folder_ / "none.json");
  ASSERT_EQ(edit("none", "--seed 3"), 0);
  EXPECT_EQ(ReadFile(folder_ / "new.npz"), free);
}

TEST_F(RetakeTest, KeysMoveOntoAnotherPath) {
  const TestServer server(std::make_unique<ControlledSampler>());
  const std::string there = " --server " + server.address() + " ";
  ASSERT_EQ(Choreo("dance " + At("song.wav") + there + "-o " + At("dance.npz") + " --report " +
                   At("report.json"))
                .code,
            0);
  const Motion before = Read("dance.npz");
  const Pose& start = before.frames[60];
  std::ofstream(folder_ / "path.json")
      << R"({"points": [{"time": 2, "x": )" << start.root_position.x() << R"(, "z": )"
      << start.root_position.z() << R"(}, {"time": 8, "x": 3, "z": 1}]})";
  const auto edit = [&](const std::string& arguments) {
    return Choreo("edit " + At("dance.npz") + there + arguments + Report("led"));
  };
  const Outcome outcome = edit("--path " + At("path.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion led = Read("led.npz");
  EXPECT_EQ(ChangedRows(folder_ / "dance.npz", folder_ / "led.npz", "rotations").first, 61U);
  // Halfway, and its end bends to the next key, which stays.
  EXPECT_NEAR(led.frames[150].root_position.x(), (start.root_position.x() + 3) / 2, 0.1);
  EXPECT_NEAR(led.frames[150].root_position.z(), (start.root_position.z() + 1) / 2, 0.1);
  EXPECT_EQ(ReadJson(folder_ / "led.json")["keyframes"].size(),
            ReadJson(folder_ / "report.json")["keyframes"].size());

  const Outcome styled = edit("--style wild");
  ASSERT_EQ(styled.code, 0) << styled.said;
  EXPECT_EQ(ReadJson(folder_ / "led.json")["style"], "wild") << "for the next edit";
}

TEST_F(RetakeTest, NewFramesFollowThePathAndTheVelocityOfTheReport) {
  const TestServer server(std::make_unique<ControlledSampler>());
  const std::string there = " --server " + server.address() + " ";
  std::ofstream(folder_ / "path.json")
      << R"({"points": [{"time": 0, "x": 0, "z": 0}, {"time": 8, "x": 4, "z": 2}]})";
  ASSERT_EQ(
      Choreo("dance " + At("song.wav") + there + "--path " + At("path.json") +
             " --velocity arms=2 -k none -o " + At("dance.npz") + " --report " + At("report.json"))
          .code,
      0);
  std::string said;
  const auto edit = [&](const std::string& dance, const std::string& arguments) {
    const auto keep = [&](const std::string& name, const std::string& as) {
      std::filesystem::copy_file(folder_ / name, folder_ / as,
                                 std::filesystem::copy_options::overwrite_existing);
    };
    keep(dance + ".npz", "before.npz");
    keep((dance == "dance" ? "report" : dance) + ".json", "before.json");
    const Outcome outcome =
        Choreo("edit " + At("before.npz") + there + arguments + " --report " + At("before.json") +
               " -o " + At("new.npz") + " --new-report " + At("new.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    said = outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr("the path, the velocity"));
    EXPECT_THAT(outcome.said, Not(HasSubstr("root path")));
  };
  const auto expect_followed = [&](size_t frame, double x, double z) {
    const Pose pose = Read("new.npz").frames[frame];
    EXPECT_NEAR(pose.root_position.x(), x, 0.1);
    EXPECT_NEAR(pose.root_position.z(), z, 0.1);
    const Skeleton& body = Skeleton::Smpl24();
    EXPECT_NEAR(pose.rotations(0, body.Find(kTellingJoints[1])), 0.04, 1e-5);
  };
  edit("dance", "--retake 2 6");
  expect_followed(120, 2, 1);
  edit("new", "--seed 9");
  expect_followed(120, 2, 1);
  EXPECT_EQ(ReadJson(folder_ / "new.json")["path"], ReadJson(folder_ / "report.json")["path"]);
  edit("dance", "--retake 8.5 9.5");  // where the path has ended
  edit("dance", "--key bow --at 9 --hold 1");
  EXPECT_THAT(said, Not(HasSubstr("(frame 299): parts do not move"))) << "in the held pose";
  // A cut dance keeps the rest of the path.
  ASSERT_EQ(Choreo("edit " + At("dance.npz") + " --from 4 --mirror --report " + At("report.json") +
                   " -o " + At("part.npz") + " --new-report " + At("part.json"))
                .code,
            0);
  edit("part", "--retake 1 3");
  expect_followed(60, -3, 1.5);
}

}  // namespace choreo::edit_retake_test
