#include "client/live/live_dance.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/server_builder.h>
#include <gtest/gtest.h>
#include <lo/lo.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "choreo/v1/choreography.grpc.pb.h"
#include "client/authoring/keys/pose_library.h"
#include "client/authoring/local_server.h"
#include "model/formats/motion_file.h"
#include "model/motion/kinematics.h"
#include "proto/wire/convert.h"
#include "tests/client/command_fixture.h"
#include "tests/client/live/osc_receiver.h"
#include "tests/client/test_music.h"
#include "tests/support/eventually.h"
#include "tests/support/expect_error.h"

namespace choreo::live_dance_test {

using testing::HasSubstr;
using testing::Not;

/// Clicks in real time, without waiting.
class HastySound final : public live::Sound {
 public:
  explicit HastySound(double seconds) : samples_(Clicks(seconds)) {}
  int sample_rate() const override { return 22050; }
  int channels() const override { return 1; }
  std::span<const float> Next() override {
    const size_t from = at_;
    at_ = std::min(at_ + 441, samples_.size());
    return std::span(samples_).subspan(from, at_ - from);
  }

 private:
  std::vector<float> samples_;
  size_t at_ = 0;
};

/// Silence until `over`, which is asked before each piece.
class SoundUntil final : public live::Sound {
 public:
  explicit SoundUntil(std::function<bool()> over) : over_(std::move(over)) {}
  int sample_rate() const override { return 22050; }
  int channels() const override { return 1; }
  std::span<const float> Next() override {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return over_() ? std::span<const float>() : silence_;
  }

 private:
  std::function<bool()> over_;
  std::vector<float> silence_ = std::vector<float>(100);
};

/// A drum machine that keeps 125 beats a minute, started with the music.
class DrumMachine final : public live::Cues {
 public:
  explicit DrumMachine(const std::string& device)
      : clock_(device), out_(open(device.c_str(), O_WRONLY)) {
    Say(0xFA);
  }
  ~DrumMachine() override { close(out_); }
  live::MidiClock& clock() { return clock_; }
  std::vector<live::Cue> Take() override {
    for (now_ += live::kPieceSeconds; ticks_ * 0.02 < now_; ++ticks_) Say(0xF8);
    return {};
  }

 private:
  void Say(uint8_t byte) const { EXPECT_EQ(write(out_, &byte, 1), 1); }

  live::MidiClock clock_;
  int out_;
  double now_ = 0;
  int ticks_ = 0;
};

/// Sends its cues before the given piece of music.
class Script final : public live::Cues {
 public:
  explicit Script(std::multimap<int, live::Cue> said) : said_(std::move(said)) {}
  std::vector<live::Cue> Take() override {
    std::vector<live::Cue> cues;
    const auto [from, to] = said_.equal_range(pieces_++);
    for (auto cue = from; cue != to; ++cue) cues.push_back(cue->second);
    return cues;
  }

 private:
  std::multimap<int, live::Cue> said_;
  int pieces_ = 0;
};

class LiveDanceTest : public CommandTest {
 protected:
  /// Four seconds of clicks, in no time.
  void Dance(std::multimap<int, live::Cue> said) {
    HastySound sound(4);
    Dance(sound, std::make_unique<Script>(std::move(said)), nullptr);
  }
  void Dance(live::Sound& sound, std::unique_ptr<live::Cues> said, live::MidiClock* midi) {
    const client::Client client({.addresses = {server_.address()}});
    const client::ModelDescription model = client.GetServerInfo().models.front();
    live::LiveOptions options;
    options.config.seed = 1;
    for (const char* name : {"kick", "groove"})
      options.poses[name] = authoring::FindLibraryPose(name).pose;
    options.most_keys = most_keys_;
    options.beats = hint_;
    live::LiveObserver observer{
        [] { return true; },
        [this](const live::LiveFigures& figures) { figures_.push_back(figures); },
        [this](const std::string& note) { notes_.push_back(note); }};
    live::LiveDance dance(client, model, std::move(options), std::move(observer));
    std::vector<std::unique_ptr<live::Cues>> cues;
    cues.push_back(std::move(said));
    dance.Run(sound, cues, midi);
    motion_ = dance.motion();
  }
  /// How far from a pose of the library a frame is, degrees.
  double Off(size_t frame, const char* pose) const {
    PoseMask mask;
    mask.root_position = false;
    return ComparePoses(Skeleton::Smpl24(), motion_.frames[frame],
                        authoring::FindLibraryPose(pose).pose, mask)
        .angle_deg;
  }

  int most_keys_ = 1000;
  BeatHint hint_;
  std::vector<live::LiveFigures> figures_;
  std::vector<std::string> notes_;
  Motion motion_;
};

// The place that gets free then is of no use.
TEST_F(LiveDanceTest, FailsIfItsMusicIsOverBeforeThereIsRoom) {
  const TestServer full(std::make_unique<FakeSampler>(), "127.0.0.1:0",
                        [](ServerConfig& config) { config.max_streams = 1; });
  std::mutex mutex;
  std::optional<Error> latest;
  const auto failure = [&] {
    const std::lock_guard lock(mutex);
    return latest;
  };
  client::Options asked{.addresses = {full.address()}};
  asked.retried = [&](const std::string& address, const Error& error) {
    EXPECT_EQ(address, full.address());
    const std::lock_guard lock(mutex);
    latest = error;
  };
  const client::Client client(asked);
  const client::ModelDescription model = client.GetServerInfo().models.front();
  const auto other = client.StartDance({.frames = 30, .generate_until = 0});
  other->GenerateUntil(10);
  ASSERT_TRUE(other->Next());
  SoundUntil sound([&] {
    if (!failure()) return false;
    other->Cancel();
    return true;
  });
  live::LiveObserver observer{[] { return true; }, [](const live::LiveFigures&) {},
                              [](const std::string&) {}};
  observer.failure = failure;
  live::LiveDance dance(client, model, {}, std::move(observer));
  try {
    dance.Run(sound, {});
    FAIL() << "it has danced to nothing";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kResourceExhausted);
    EXPECT_THAT(error.what(), HasSubstr("of at most 1; it asks to try again in"));
  }
}

// A server that ends each dance at once and says that it reached a key.
class LyingServer final : public v1::Choreography::Service {
 public:
  LyingServer() {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
    server_->GetHealthCheckService()->SetServingStatus("choreo.v1.Choreography", true);
  }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  grpc::Status StreamDance(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<v1::StreamDanceResponse, v1::StreamDanceRequest>* stream) override {
    v1::StreamDanceRequest request;
    stream->Read(&request);
    v1::StreamDanceResponse response;
    *response.mutable_header()->mutable_skeleton() = wire::ToProto(Skeleton::Smpl24());
    response.mutable_header()->set_frame_rate(30);
    response.mutable_header()->set_model_frame_rate(30);
    stream->Write(response);
    response.mutable_summary()->mutable_report()->add_keyframes()->set_id("nobody's");
    stream->Write(response);
    return grpc::Status::OK;
  }

 private:
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST_F(LiveDanceTest, FailsAtAReportOfAKeyThatNobodySent) {
  const client::ModelDescription model =
      client::Client({.addresses = {server_.address()}}).GetServerInfo().models.front();
  const LyingServer server;
  const client::Client client({.addresses = {server.address()}});
  live::LiveDance dance(
      client, model, {},
      {[] { return true; }, [](const live::LiveFigures&) {}, [](const std::string&) {}});
  HastySound sound(1);
  dance.Run(sound, {});
  ExpectError(ErrorCode::kInternal, "nobody's", [&] { dance.DancedKeys(); });
}

TEST_F(LiveDanceTest, EndsWithItsMusicAndReportsEachSecond) {
  Dance({});
  EXPECT_EQ(motion_.frames.size(), 120U);
  ASSERT_EQ(figures_.size(), 5U);  // the last one is of all
  EXPECT_EQ(figures_[0].seconds, 1);
  EXPECT_EQ(figures_[4].seconds, 4);
  EXPECT_EQ(figures_[4].frames, 120);
  EXPECT_TRUE(notes_.empty()) << notes_.front();
}

// Piece 25 begins at 0.5 s; no beat is known so early. The third would come with the second, and
// the fifth after the music's end.
TEST_F(LiveDanceTest, PosesComeASecondAfterTheirCuesAndApart) {
  Dance({{24, {"kick"}}, {75, {"groove"}}, {75, {"kick"}}, {80, {"nobody"}}, {170, {"kick"}}});
  EXPECT_LT(Off(45, "kick"), 0.1);
  EXPECT_LT(Off(76, "groove"), 0.1);
  EXPECT_LT(Off(92, "kick"), 0.1);
  ASSERT_EQ(motion_.frames.size(), 120U);
  EXPECT_EQ(figures_.back().keys_taken, 4);
  EXPECT_EQ(figures_.back().keys_danced, 3);
  EXPECT_EQ(figures_.back().keys_refused, 0);
  EXPECT_THAT(notes_, testing::ElementsAre("there is no pose \"nobody\""));
}

TEST_F(LiveDanceTest, PoseCanBeRemovedUntilItIsDanced) {
  Dance({{24, {"kick"}}, {40, {}}, {99, {"groove", 1.5}}, {150, {}}, {170, {}}});
  EXPECT_GT(Off(45, "kick"), 5);
  EXPECT_EQ(figures_.back().keys_danced, 0);
  EXPECT_THAT(notes_, testing::ElementsAre("no pose can be removed"));
}

// The groove is later, but the kick was requested last.
TEST_F(LiveDanceTest, UndoRemovesTheLastRequestedPose) {
  Dance({{24, {"groove", 2.5}}, {25, {"kick"}}, {30, {}}});
  EXPECT_GT(Off(45, "kick"), 5);
  EXPECT_LT(Off(90, "groove"), 0.1);
  EXPECT_EQ(figures_.back().keys_danced, 1);
}

TEST_F(LiveDanceTest, ExcessPosesAreRefusedAndTheDanceContinues) {
  most_keys_ = 2;
  Dance({{24, {"kick"}}, {49, {"groove"}}, {74, {"kick"}}});
  EXPECT_EQ(motion_.frames.size(), 120U);
  EXPECT_EQ(figures_.back().keys_taken, 2);
  EXPECT_EQ(figures_.back().keys_danced, 2);
  EXPECT_EQ(figures_.back().keys_refused, 1);
  EXPECT_THAT(notes_, testing::ElementsAre(HasSubstr("already has all 2 poses")));
}

TEST_F(LiveDanceTest, AMinuteOfPosesWaitsAtMost) {
  std::multimap<int, live::Cue> flood;
  for (int i = 0; i < 500; ++i) flood.insert({24, {"kick"}});
  Dance(std::move(flood));
  EXPECT_GE(motion_.frames.size(), 120U);
  EXPECT_GT(figures_.back().keys_taken, 100);
  EXPECT_LT(figures_.back().keys_taken, 130);
  EXPECT_EQ(figures_.back().keys_taken + figures_.back().keys_refused, 500);
  EXPECT_LE(notes_.size(), 7U);  // the last one tells of a pose behind the music's end
  EXPECT_THAT(notes_, testing::Contains(HasSubstr(" more, not shown")));
}

TEST_F(LiveDanceTest, NotesAreEscaped) {
  Dance({{24, {"\x1b[2J\nkick"}}});
  EXPECT_THAT(notes_, testing::ElementsAre("there is no pose \"\\x1b[2J\\x0akick\""));
}

// The music has 120 beats a minute, the clock 125.
TEST_F(LiveDanceTest, FollowsTheBeatsOfAMidiClock) {
  const std::string device = folder_ / "midi";
  ASSERT_EQ(mkfifo(device.c_str(), 0600), 0);
  WriteClicks(folder_ / "song.wav", 6);
  auto drums = std::make_unique<DrumMachine>(device);
  live::MidiClock* midi = &drums->clock();
  Dance(*live::PlaySong(DecodeAudioFile(folder_ / "song.wav")), std::move(drums), midi);
  bool told = false;
  for (const live::LiveFigures& figures : figures_) {
    if (!figures.tempo) continue;
    EXPECT_NEAR(*figures.tempo, 125, 2);
    EXPECT_EQ(figures.confidence, 1);
    told = true;
  }
  EXPECT_TRUE(told);
}

// The music has 120 beats a minute.
TEST_F(LiveDanceTest, HalfTimeIsDancedToEverySecondBeat) {
  WriteClicks(folder_ / "song.wav", 12);
  hint_.half_time = true;
  Dance(*live::PlaySong(DecodeAudioFile(folder_ / "song.wav")),
        std::make_unique<Script>(std::multimap<int, live::Cue>()), nullptr);
  const std::optional<double> tempo = figures_[figures_.size() - 2].tempo;
  ASSERT_TRUE(tempo);
  for (const live::LiveFigures& figures : figures_) {
    EXPECT_NEAR(figures.tempo.value_or(60), 60, 2) << "at " << figures.seconds << " s";
  }
  EXPECT_THAT(notes_, testing::IsEmpty());
}

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
                                       ": the server is full: 1 calls are in progress, of at most "
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

}  // namespace choreo::live_dance_test
