#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lo/lo.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "client/authoring/keys/pose_library.h"
#include "client/authoring/local_server.h"
#include "client/choreo_client.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/live/osc_receiver.h"
#include "tests/client/test_music.h"
#include "tests/support/eventually.h"

/// `choreo live`, as people run it.
namespace choreo::live_command_test {

using testing::HasSubstr;
using testing::Not;

TEST_F(CommandTest, ALiveDanceHasKeysOfAFileAndIsStreamed) {
  WriteClicks(folder_ / "song.wav", 3);
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [{"time": 2, "pose": "kick"}]})";
  OscReceiver receiver;
  const Outcome outcome =
      Choreo("live " + At("song.wav") + Server() + "-k " + At("keys.json") + " -o " + At("d.npz") +
             " --song-start 0.5 --vmc " + receiver.address() + " </dev/null");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  for (const char* said : {"1 s: ", "2 s: ", "75 frames, ", "0 taken, 1 danced, 0 refused"})
    EXPECT_THAT(outcome.said, HasSubstr(said));
  const Motion motion = ReadMotion(folder_ / "d.npz", Skeleton::Smpl24());
  EXPECT_EQ(motion.frames.size(), 75U);
  EXPECT_EQ(receiver.Stop().size(), 1 + motion.frames.size());
}

// Clicks come every half second from second 0 on.
TEST_F(CommandTest, ALiveDanceHasKeysOnCountsOfItsSong) {
  WriteClicks(folder_ / "song.wav", 5);
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"time": "5c", "pose": "kick", "hold": "2c"}]})";
  const Outcome analysed = Choreo("analyze " + At("song.wav") + " --json");
  const nlohmann::json heard = nlohmann::json::parse(analysed.said);
  const auto one =
      std::ranges::find(heard["beats"], heard["downbeats"][0]) - heard["beats"].begin();
  const double fifth = heard["beats"][static_cast<size_t>(one) + 4];
  const Outcome outcome =
      Choreo("live " + At("song.wav") + Server() + "-k " + At("keys.json") + " -o " + At("d.npz") +
             " --report " + At("r.json") + " </dev/null");
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion motion = ReadMotion(folder_ / "d.npz", Skeleton::Smpl24());
  const auto frame = static_cast<size_t>(std::llround(fifth * motion.fps));
  PoseMask mask;
  mask.root_position = false;
  EXPECT_LT(ComparePoses(Skeleton::Smpl24(), motion.frames.at(frame),
                         authoring::FindLibraryPose("kick").pose, mask)
                .angle_deg,
            0.1);
  // Edits count alike.
  const Outcome edited =
      Choreo("edit " + At("d.npz") + Server() + "--key dab --at 5c --report " + At("r.json") +
             " -o " + At("e.npz") + " --new-report " + At("e.json"));
  ASSERT_EQ(edited.code, 0) << edited.said;
  EXPECT_EQ(ReadJson(folder_ / "e.json")["keyframes"][0]["id"], "dab");
  EXPECT_EQ(ReadJson(folder_ / "e.json")["keyframes"][0]["frame"], frame);
}

TEST_F(CommandTest, ALiveDanceHasAStyleAPathAndAReport) {
  WriteClicks(folder_ / "song.wav", 4);
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "k", "time": 1, "pose": "kick", "hold": 0.4}]})";
  std::ofstream(folder_ / "path.json") << R"({"points": [{"time": 2, "x": 0, "z": 0},
                                                         {"time": 3.5, "x": 1, "z": 0}]})";
  const TestServer server(std::make_unique<ControlledSampler>());
  const std::string there = " --server " + server.address() + " ";
  const auto live = [&](const std::string& rest) {
    return Choreo("live " + At("song.wav") + there + rest + " </dev/null");
  };
  const Outcome outcome = live("-k " + At("keys.json") + " --style wild --path " + At("path.json") +
                               " -o " + At("d.npz") + " --report " + At("r.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  const Motion motion = ReadMotion(folder_ / "d.npz", Skeleton::Smpl24());
  EXPECT_NEAR(motion.frames.at(104).root_position.x(), 1, 0.1);
  const nlohmann::json report = ReadJson(folder_ / "r.json");
  EXPECT_EQ(report["frames"], motion.frames.size());
  EXPECT_EQ(report["style"], "wild");
  ASSERT_EQ(report["keyframes"].size(), 3U);
  EXPECT_EQ(report["keyframes"][0]["id"], "k");
  EXPECT_EQ(report["keyframes"][2]["holds"], "k");
  EXPECT_LT(report["keyframes"][0]["output_error_deg"].get<double>(), 0.1);
  const Outcome edited = Choreo("edit " + At("d.npz") + there + "--move k 1.2 --report " +
                                At("r.json") + " -o " + At("e.npz"));
  EXPECT_EQ(edited.code, 0) << edited.said;
  EXPECT_THAT(live("--style sleepy").said, HasSubstr("--style: "));
  EXPECT_THAT(live("--report " + At("song.wav")).said, HasSubstr("--report: "));
}

TEST_F(CommandTest, ALiveDanceTakesKeysOverOsc) {
  WriteClicks(folder_ / "song.wav", 4);
  const int port = OscReceiver().port();
  std::atomic<bool> over = false;
  std::thread performer([&] {
    const std::unique_ptr<void, void (*)(lo_address)> to(
        lo_address_new("127.0.0.1", std::to_string(port).c_str()), lo_address_free);
    while (!over) {
      lo_send(to.get(), "/choreo/key", "s", "kick");
      lo_send(to.get(), "/choreo/key", "sf", "nobody", 1.0F);
      lo_send(to.get(), "/choreo/key", "i", 5);
      for (const float never : {1e9F, -5.0F, NAN})
        lo_send(to.get(), "/choreo/key", "sf", "dab", never);
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  });
  const Outcome outcome =
      Choreo("live " + At("song.wav") + Server() + "--osc " + std::to_string(port) + " </dev/null");
  over = true;
  performer.join();
  ASSERT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, HasSubstr("there is no pose \"nobody\""));
  for (const std::string never : {"1000000000", "-5", "nan"})
    EXPECT_THAT(outcome.said, testing::ContainsRegex("dab: " + never + "[.0]* s ahead is not in"));
  EXPECT_THAT(outcome.said,
              testing::ContainsRegex(" [1-9][0-9]* taken, [1-9][0-9]* danced, 0 ref"));
}

TEST_F(CommandTest, ALiveDanceReportsALostServerAtOnce) {
  WriteClicks(folder_ / "song.wav", 60);
  auto server = std::make_unique<authoring::LocalServer>(FAKE_CHOREOD);
  OscReceiver watched;
  std::thread killer([&] {
    EXPECT_TRUE(Eventually([&] { return watched.count() > 45; }));  // the last key is at 1.1 s
    kill(server->process(), SIGKILL);
  });
  std::ofstream(folder_ / "keys.json")
      << R"({"keyframes": [{"id": "k", "time": 0.7, "pose": "kick", "hold": 0.4}]})";
  const Outcome outcome =
      Choreo("live " + At("song.wav") + " -k " + At("keys.json") + " -o " + At("d.npz") +
             " --report " + At("r.json") + " --vmc " + watched.address() + " --server " +
             server->address() + " </dev/null");
  killer.join();
  EXPECT_EQ(outcome.code, 1);
  const size_t lost = outcome.said.find("note: " + server->address() + ": ");
  ASSERT_NE(lost, std::string::npos) << outcome.said;
  // Well before it is given up.
  EXPECT_THAT(outcome.said.substr(lost), HasSubstr(" s: 0 frames"));
  // What was danced can be edited.
  EXPECT_THAT(outcome.said, HasSubstr("r.json"));
  const nlohmann::json report = ReadJson(folder_ / "r.json");
  EXPECT_EQ(report["frames"], ReadMotion(folder_ / "d.npz", Skeleton::Smpl24()).frames.size());
  EXPECT_FALSE(report.contains("skate_ratio")) << "nobody measured it";
  ASSERT_EQ(report["keyframes"].size(), 3U);
  EXPECT_EQ(report["keyframes"][2]["holds"], "k");
  const Outcome edited = Choreo("edit " + At("d.npz") + Server() + "--remove k --report " +
                                At("r.json") + " -o " + At("e.npz"));
  EXPECT_EQ(edited.code, 0) << edited.said;
}

TEST_F(CommandTest, ALiveDanceNamesAFullServerItsLimitAndWhenToComeAgain) {
  WriteClicks(folder_ / "song.wav", 4);
  setenv("CHOREO_MAX_STREAMS", "1", 1);
  const authoring::LocalServer server(FAKE_CHOREOD);
  unsetenv("CHOREO_MAX_STREAMS");
  const client::Client other({.addresses = {server.address()}});
  const auto dance = other.StartDance({.frames = 30, .generate_until = 0});
  dance->GenerateUntil(10);
  ASSERT_TRUE(dance->Next());
  const Outcome outcome =
      Choreo("live " + At("song.wav") + " --server " + server.address() + " </dev/null");
  EXPECT_EQ(outcome.code, 1);
  for (const std::string begin : {"note: ", "choreo: "}) {
    EXPECT_THAT(outcome.said,
                testing::ContainsRegex(begin + server.address() +
                                       ": the server is full: 1 call is in progress, of at most "
                                       "1; it asks to try again in [0-9]+ s"));
  }
}

TEST_F(CommandTest, ALiveDanceGoesOnInexactlyIfAsked) {
  WriteClicks(folder_ / "song.wav", 3);
  for (const bool asked : {false, true}) {
    const TestServer breaks(std::make_unique<BreakingSampler>(20)), other("another build");
    const Outcome outcome =
        Choreo("live " + At("song.wav") + " --server " + breaks.address() + " --server " +
               other.address() + (asked ? " --allow-inexact-resume" : "") + " </dev/null");
    EXPECT_EQ(outcome.code == 0, asked) << outcome.said;
  }
}

TEST_F(CommandTest, ALiveDanceEndsInOrderWhenInterrupted) {
  WriteClicks(folder_ / "song.wav", 60);
  const std::string pid_file = (folder_ / "pid").string();
  OscReceiver watched;
  std::thread sender([&] {
    EXPECT_TRUE(Eventually([&] { return watched.count() > 5; }));
    pid_t process = 0;
    if (std::ifstream(pid_file) >> process) kill(process, SIGINT);
  });
  const Outcome outcome =
      Choreo("live " + At("song.wav") + Server() + "-o " + At("d.npz") + " --report " +
                 At("r.json") + " --vmc " + watched.address() + " </dev/null",
             "echo $$ > '" + pid_file + "'; exec ");
  sender.join();
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  const size_t frames = ReadMotion(folder_ / "d.npz", Skeleton::Smpl24()).frames.size();
  EXPECT_GT(frames, 0U);
  EXPECT_LT(frames, 1800U);
  EXPECT_EQ(ReadJson(folder_ / "r.json")["frames"], frames);
}

TEST_F(CommandTest, ALiveDanceRefusesImpossibleOptions) {
  const auto live = [&](const std::string& rest) { return Choreo("live " + rest + Server()); };
  WriteClicks(folder_ / "song.wav", 1);
  EXPECT_THAT(live("--input no-such-card").said, HasSubstr("--input: \"no-such-card\""));
  EXPECT_THAT(live(At("song.wav") + " --song-start 2").said,
              HasSubstr("--song-start: 2 s is after"));
  EXPECT_THAT(live(At("song.wav") + " --ahead 0.2").said,
              HasSubstr("--ahead: 0.2 s does not exceed --look-ahead, 0.3 s"));
  EXPECT_THAT(live(At("song.wav") + " --deadline 5").said, HasSubstr("--deadline: a live dance"));
  EXPECT_THAT(live(At("song.wav") + " --beats beats.txt").said,
              HasSubstr("--beats: names the beats of a whole song"));
  EXPECT_THAT(live(At("song.wav") + " --downbeat 0.5").said,
              HasSubstr("--downbeat: names a second of a song"));
  EXPECT_EQ(live(At("song.wav") + " --beats auto --half-time").code, 0);
  EXPECT_THAT(live(At("song.wav") + " --tempo 20").said, HasSubstr("--tempo: "));
  EXPECT_THAT(live(At("song.wav") + " -k none -k a.json").said,
              HasSubstr("--keyframes: none cannot be combined with a.json"));
  EXPECT_EQ(live(At("song.wav") + " -k none").code, 0);
  EXPECT_THAT(live(At("song.wav") + " --input default").said, HasSubstr("song excludes --input"));
  std::ofstream(folder_ / "keys.json") << R"({"keyframes": [{"time": 2, "pose": "kick"}]})";
  EXPECT_THAT(live(At("song.wav") + " -k " + At("keys.json")).said,
              HasSubstr("keys.json:keyframes[0].time: key \"key1\" at 2 s is after the dance's "
                        "end: its last frame is at 0.97 s"));
  std::ofstream(folder_ / "counted.json") << R"({"keyframes": [{"time": "3c", "pose": "kick"}]})";
  EXPECT_THAT(live("--input null -k " + At("counted.json")).said,
              HasSubstr("keyframes[0].time: 3c: the beats of live music are not known in advance; "
                        "use seconds, or name the song's file"));
  const OscReceiver taken;
  EXPECT_THAT(live(At("song.wav") + " --osc " + std::to_string(taken.port())).said,
              HasSubstr("--osc: port "));
}

TEST_F(CommandTest, ALiveDanceTellsOfItsSongAndReadsStandardInput) {
  WriteClicks(folder_ / "song.wav", 2);
  std::filesystem::resize_file(folder_ / "song.wav",
                               std::filesystem::file_size(folder_ / "song.wav") / 2);
  const Outcome cut = Choreo("live " + At("song.wav") + Server() + "</dev/null");
  EXPECT_EQ(cut.code, 0) << cut.said;
  EXPECT_THAT(cut.said, HasSubstr("song.wav: its header says "));
  const Outcome piped =
      Choreo("live -" + Server() + "--report " + At("r.json") + " --half-time <" + At("song.wav"));
  EXPECT_EQ(piped.code, 0) << piped.said;
  EXPECT_FALSE(ReadJson(folder_ / "r.json").contains("song"));
}

// Nothing else is done for what can't be danced to.
TEST_F(CommandTest, ALiveDanceReadsItsSongBeforeItAsksForAServer) {
  std::ofstream(folder_ / "empty.wav").close();
  const Outcome outcome = Choreo("live " + At("empty.wav") + " --server 127.0.0.1:1");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("empty.wav: "));
  EXPECT_THAT(outcome.said, Not(HasSubstr("127.0.0.1")));
}

}  // namespace choreo::live_command_test
