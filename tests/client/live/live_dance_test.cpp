#include "client/live/live_dance.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "client/authoring/keys/pose_library.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/client/command_fixture.h"
#include "tests/client/scripted_server.h"
#include "tests/client/test_music.h"
#include "tests/support/expect_error.h"

namespace choreo::live_dance_test {

using testing::HasSubstr;

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

TEST_F(LiveDanceTest, FailsAtAReportOfAKeyThatNobodySent) {
  const client::ModelDescription model =
      client::Client({.addresses = {server_.address()}}).GetServerInfo().models.front();
  const ScriptedServer server([](ScriptedServer::Stream& stream) {
    stream.Write(ScriptedServer::Header());
    v1::StreamDanceResponse end;
    end.mutable_summary()->mutable_report()->add_keyframes()->set_id("nobody's");
    stream.Write(end);
    return grpc::Status::OK;
  });
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

}  // namespace choreo::live_dance_test
