#include "client/edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "client/cli/pose_library.h"
#include "model/formats/motion_file.h"
#include "model/formats/npz.h"
#include "model/motion/canonical.h"
#include "model/motion/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/test_music.h"
#include "tests/support/expect_error.h"

namespace choreo::edit_test {

using testing::HasSubstr;

const Skeleton& Body() { return Skeleton::Smpl24(); }

/// Largest acceleration of a joint at a frame, m/s^2; past the end the dance begins again.
double AccelerationAt(const Motion& motion, size_t frame) {
  const size_t count = motion.frames.size();
  const auto joints = [&](size_t at) { return JointPositions(Body(), motion.frames[at % count]); };
  const Eigen::Matrix3Xd second = joints(frame + count - 1) - 2 * joints(frame) + joints(frame + 1);
  return second.colwise().norm().maxCoeff() * motion.fps * motion.fps;
}

double LargestAcceleration(const Motion& motion, size_t first, size_t last) {
  double largest = 0;
  for (size_t frame = first; frame <= last; ++frame)
    largest = std::max(largest, AccelerationAt(motion, frame));
  return largest;
}

/// Rows of an array in two files that differ in any bit: the first, and the one behind the last.
std::pair<size_t, size_t> ChangedRows(const std::filesystem::path& a,
                                      const std::filesystem::path& b, const std::string& key) {
  const NpyArray left = NpzArchive::Read(a).Array(key);
  const NpyArray right = NpzArchive::Read(b).Array(key);
  EXPECT_EQ(left.shape, right.shape) << key;
  const auto rows = static_cast<size_t>(left.shape[0]);
  const auto x = left.As<double>();
  const auto y = right.As<double>();
  const size_t width = x.size() / rows;
  size_t first = rows;
  size_t end = 0;
  for (size_t row = 0; row < rows; ++row) {
    if (std::memcmp(&x[row * width], &y[row * width], width * sizeof(double)) == 0) continue;
    first = std::min(first, row);
    end = row + 1;
  }
  return {first, end};
}

class EditTest : public CommandTest {
 protected:
  void SetUp() override {
    WriteClicks(folder_ / "song.wav", 10);
    const Outcome outcome = Choreo("dance " + At("song.wav") + Server() + "--seed 3 -o " +
                                   At("dance.npz") + " --report " + At("report.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.said;
    const nlohmann::json report = ReadJson(folder_ / "report.json");
    for (const auto& key : report["keyframes"]) keys_.push_back(key["frame"]);
    ASSERT_GE(keys_.size(), 4U);
  }

  Outcome Edit(const std::string& arguments) {
    return Choreo("edit " + At("dance.npz") + Server() + arguments);
  }
  Motion Read(const std::string& name) const { return ReadMotion(folder_ / name, Body()); }
  static std::string Seconds(size_t frame) {
    return std::to_string(static_cast<double>(frame) / 30);
  }

  /// Every array of the file differs in these frames and in no other.
  void ExpectChanged(const std::string& name, size_t first, size_t end) {
    for (const char* key : {"rotations", "root_positions", "poses", "trans"}) {
      EXPECT_EQ(ChangedRows(folder_ / "dance.npz", folder_ / name, key), std::pair(first, end))
          << key;
    }
    const auto contacts = ChangedRows(folder_ / "dance.npz", folder_ / name, "contacts");
    EXPECT_GE(contacts.first, first);
    EXPECT_LE(contacts.second, end);
  }

  std::vector<size_t> keys_;
};

TEST_F(EditTest, AKeyChangesTheTwoIntervalsAroundItAlone) {
  const Outcome outcome =
      Edit("--key kick --at " + Seconds(keys_[2]) + " --song " + At("song.wav") + " --report " +
           At("report.json") + " -o " + At("new.npz") + " --new-report " + At("new.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  ExpectChanged("new.npz", keys_[1] + 1, keys_[3]);

  // The pose is there, where the dancer was.
  const Motion before = Read("dance.npz");
  const Motion after = Read("new.npz");
  const Pose& there = after.frames[keys_[2]];
  const GroundFrame place = GroundFrame::Of(before.frames[keys_[2]]);
  const PoseError error =
      ComparePoses(Body(), there, place.ToWorld(cli::FindLibraryPose("kick").pose));
  EXPECT_LE(error.position_m, 0.001);
  EXPECT_LE(error.angle_deg, 0.1);

  // The report names it, in the place of the key that stood there.
  const auto reported = ReadJson(folder_ / "new.json")["keyframes"];
  ASSERT_EQ(reported.size(), keys_.size());
  EXPECT_EQ(reported[2]["id"], "kick");
  EXPECT_EQ(reported[2]["frame"], keys_[2]);
  EXPECT_LE(reported[2]["final_error_m"], 0.001);
}

TEST_F(EditTest, TheNewReportKeepsTheWarningsOfWhatStays) {
  nlohmann::json report = ReadJson(folder_ / "report.json");
  report["warnings"] = nlohmann::json::array();
  for (const size_t frame : {keys_[3] + 1, keys_[3], keys_[1] + 1, keys_[1]})
    report["warnings"].push_back({{"frame", frame}, {"message", std::to_string(frame)}});
  std::ofstream(folder_ / "warned.json") << report;
  const std::string edit = "--key kick --at " + Seconds(keys_[2]) + " --report " +
                           At("warned.json") + " -o " + At("new.npz") + " --new-report ";
  const Outcome outcome = Edit(edit + At("new.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  // The way to keys_[3] is another one now.
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
  EXPECT_LE(LargestAcceleration(loop, 298, 301), 1.2 * usual);
}

TEST_F(EditTest, AnotherFrameRateKeepsItsFramesToo) {
  ASSERT_EQ(
      Choreo("dance " + At("song.wav") + Server() + "--seed 3 --fps 60 -o " + At("dance.npz")).code,
      0);
  ASSERT_EQ(Edit("--key kick --at 5 -o " + At("new.npz")).code, 0);
  ExpectChanged("new.npz", 181, 420);  // 2 s around frame 300, at 60 a second
  const Motion after = Read("new.npz");
  EXPECT_EQ(after.fps, 60);
  const GroundFrame place = GroundFrame::Of(Read("dance.npz").frames[300]);
  EXPECT_LE(
      ComparePoses(Body(), after.frames[300], place.ToWorld(cli::FindLibraryPose("kick").pose))
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
                        place.ToWorld(cli::FindLibraryPose(pose).pose));
  };
  EXPECT_LE(error(0, "kick").position_m, 0.001);
  EXPECT_LE(error(299, "groove").position_m, 0.001);
  EXPECT_EQ(before.frames[60].rotations, after.frames[60].rotations);
  EXPECT_EQ(before.frames[239].rotations, after.frames[239].rotations);
}

TEST_F(EditTest, ADanceThatTurnedMoreThanOnceIsNoObstacle) {
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

TEST_F(EditTest, SaysWhatCannotBe) {
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
  expect_failure("--key swan --at 1", "swan: is no pose of the library");
  expect_failure("--key kick --at 3 --key groove --at 3.001",
                 "--key: kick and groove both ask for frame 90");
  for (const std::string around : {"1e300", "0.01", "60"}) {
    expect_failure("--key kick --at 5 --around " + around,
                   "s, must be 0.067 to 59.97 s: 2 to 1799 frames");
  }
  expect_failure("--key kick --at 11",
                 "11 s lies behind the dance, which has its last frame at 9.97 s");
  expect_failure("--key kick --at " + Seconds(keys_[1] + 1) + " --report " + At("report.json"),
                 "s lies 1 frame from the key at ");
  expect_failure(
      "--key kick --at 3 --key groove --at 3.03",
      "--at: 3.03 s lies 1 frame from the key at 3 s, must be at least 2 frames from it");
  expect_failure("--key kick --at 0.03",
                 "--at: 0.03 s lies 1 frame from an end of the dance, at 0 s");
  expect_failure("--key kick --at 2 --report " + At("other.json"), "far stands at frame 900");
  std::ofstream(folder_ / "huge.json")
      << R"({"fps": 30.0, "keyframes": [{"id": "far", "frame": 18446744073709551615}]})";
  expect_failure(
      "--key kick --at 2 --report " + At("huge.json"),
      "keyframes[0]: has no id, or no frame that is a whole number from 0 to 1000000000");
  std::ofstream(folder_ / "deep.json") << std::string(1'000'000, '[');
  expect_failure("--key kick --at 2 --report " + At("deep.json"), "more than 64 levels");
  expect_failure("--key kick --at 2 --report " + At("song.wav"), "is not the report of a dance");
  expect_failure("--loop --new-report " + At("n.json"), "--new-report: needs --report");
}

TEST_F(EditTest, AMovedKeyStandsAtItsNewSecondAlone) {
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

  // Beyond its neighbour, what it leaves is danced anew, too.
  outcome = Edit(with_reports + "' " + Seconds(keys_[3] + 9));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_LE(off(keys_[3] + 9), 0.001);
  EXPECT_GT(off(keys_[2]), 0.01);
  keys = ReadJson(folder_ / "new.json")["keyframes"];
  ASSERT_EQ(keys.size(), keys_.size());
  EXPECT_EQ(keys[2]["frame"], keys_[3]);
  EXPECT_EQ(keys[3]["id"], id);
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
  EXPECT_THAT(outcome.said, HasSubstr("--remove: the report has no key \"nosuch\"; it has \"" +
                                      keys[0]["id"].get<std::string>()));
  outcome = Edit("--move nosuch 3 -o " + At("other.npz"));
  EXPECT_THAT(outcome.said, HasSubstr("--move: needs --report"));
}

TEST_F(EditTest, AHeldEndStaysBeforeTheWayBack) {
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "a", "time": 1, "pose": "stand", "place": [0, 0]},
                           {"id": "b", "time": 3, "pose": "kick", "place": [0, 0], "hold": 0.5},
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
  EXPECT_EQ(looped["keyframes"].size(), 3U + 5 + 10);

  // What holds a key goes with it.
  outcome = Edit("--move b 2.5 -o " + At("new.npz") + reports);
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion moved = Read("new.npz");
  for (const size_t frame : {75, 78, 81, 84, 87, 90}) {
    const Pose& pose = moved.frames[frame];
    EXPECT_LE(ComparePoses(Body(), pose, before.frames[frame + 15]).position_m, 0.001) << frame;
  }
  const nlohmann::json edited = ReadJson(folder_ / "new.json");
  EXPECT_EQ(edited["keyframes"][1]["frame"], 75);
  EXPECT_EQ(edited["keyframes"][6]["holds"], "b");
  EXPECT_EQ(edited["keyframes"][6]["frame"], 90);
  outcome = Edit("--move b 4.8 -o " + At("no.npz") + reports);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("held over the key \"end\" at 5 s"));
}

/// A dance of the client library, standing still.
client::FinishedDance Standing(size_t frames) {
  client::FinishedDance dance;
  dance.motion.frames.assign(frames, RestPose(Body()));
  return dance;
}

// Only what the new frames hear is sent: a song may be longer than a message.
TEST(EditLibraryTest, HearsTheMusicAroundTheKeyAlone) {
  TestServer server(std::make_unique<HearingSampler>());
  const client::Client client({.addresses = {server.address()}});
  client::EditOptions options;
  options.model = client.GetServerInfo().models.front();
  const client::FinishedDance dance = Standing(7000);
  client::KeyEdit edit;
  edit.key.id = "kick";
  edit.key.frame = 6000;
  edit.key.pose = cli::FindLibraryPose("kick").pose;
  edit.from = 5950;
  edit.to = 6050;
  const client::FinishedDance silent = SetKey(client, dance, options, edit).dance;
  options.audio = ClicksAudio(220);  // 18.5 MiB
  const client::FinishedDance heard = SetKey(client, dance, options, edit).dance;
  EXPECT_NE(heard.motion.frames[5980].rotations, silent.motion.frames[5980].rotations);
  EXPECT_EQ(heard.motion.frames[6050].rotations, silent.motion.frames[6050].rotations);

  // Behind the song's end the dancer hears silence.
  edit.key.frame = 6900;
  edit.from = 6850;
  edit.to = 6950;
  EXPECT_EQ(SetKey(client, dance, options, edit).keys.size(), 1U);
}

TEST(EditLibraryTest, WarnsOfTheKneeThatBendsFurthestBackwards) {
  TestServer server;
  const client::Client client({.addresses = {server.address()}});
  client::EditOptions options;
  options.model = client.GetServerInfo().models.front();
  client::FinishedDance dance = Standing(100);
  EXPECT_TRUE(CloseLoop(client, dance, options, 40).warnings.empty());
  // A loop into a broken first frame, which is not a new one: the way there is.
  dance.motion.frames[0].rotations(0, Body().left_knee) = -0.6;
  const auto warnings = CloseLoop(client, dance, options, 40).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0].message, testing::MatchesRegex("left_knee bends [0-9.]+ degrees "
                                                         "backwards at frame [0-9]+; 15 look "
                                                         "broken"));
  EXPECT_GT(warnings[0].frame, 80);
  EXPECT_LT(warnings[0].frame, 100);
}

TEST(EditLibraryTest, RefusesWhatIsNoInterval) {
  TestServer server;
  const client::Client client({.addresses = {server.address()}});
  client::EditOptions options;
  options.model = client.GetServerInfo().models.front();
  const client::FinishedDance dance = Standing(100);
  const auto refused = [&](int64_t frame, int64_t from, int64_t to, const char* part) {
    client::KeyEdit edit;
    edit.key.frame = frame;
    edit.key.pose = RestPose(Body());
    edit.from = from;
    edit.to = to;
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { SetKey(client, dance, options, edit); });
  };
  refused(100, 90, 110, "key.frame: 100 is not in the dance, [0, 99]");
  refused(50, 49, 60, "from: 49");
  refused(50, -1, 60, "from: -1");
  refused(0, 0, 60, "from: 0 with a key at frame 0: must be -1");
  refused(50, 40, 51, "to: 51");
  refused(50, 40, 100, "to: 100");
  ExpectError(ErrorCode::kInvalidArgument, "from: 99 is not in [0, 98]",
              [&] { CloseLoop(client, dance, options, 99); });
  options.audio.format.kind = client::AudioKind::kFile;
  refused(50, 40, 60, "audio: is a file");
}

}  // namespace choreo::edit_test
