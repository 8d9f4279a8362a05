#include <algorithm>
#include <thread>

#include "tests/server/fixture.h"

/// An answer depends only on the ordered messages: not on load, on how music is cut, on when a
/// message arrives, or on where a dance was resumed.
namespace choreo::determinism_test {

enum class Heard {
  kBeats,      // alone, so that a resume hears no more than its last poses did
  kAllThereIs  // how loud it is, and a passage that returns
};

class DeterminismTest : public ServerTest, public testing::WithParamInterface<Heard> {
 protected:
  static bool HearsAll() { return GetParam() == Heard::kAllThereIs; }

  static v1::DanceConfig MusicConfig(uint64_t seed) {
    v1::DanceConfig config = Config(seed);
    *config.mutable_audio_format() = MusicFormat();
    for (const double beat : {0.5, 1.0, 1.5, 2.0, 2.5}) config.add_music_beats(beat);
    if (!HearsAll()) {
      config.set_music_dynamics(0);
      return config;
    }
    v1::MusicPassage* passage = config.add_music_passages();
    passage->set_from(kReturns);
    passage->set_to(2 * kReturns);
    config.set_variation(0.4);
    return config;
  }
  static v1::Keyframe SecondKey() { return Key("b", 70, -0.2, 0.9, 1.5F); }

  // A dance with music and two keys; `chunk` bytes of music a message.
  Answer Stream(uint64_t seed, size_t chunk) {
    DanceClient client(stub());
    client.Send(MusicConfig(seed));
    client.SendKeyframe(Key("a", 30));
    client.SendKeyframe(SecondKey());
    for (size_t at = 0; at < music_.size(); at += chunk) {
      client.SendAudio(music_.substr(at, chunk), static_cast<int64_t>(at / 2));
    }
    client.SendEndOfAudio();
    client.SendKeyframesComplete();
    return client.Finish();
  }

  // The way to the first of these keys.
  Answer Transition(uint64_t seed) {
    v1::GenerateTransitionRequest request;
    *request.mutable_config() = MusicConfig(seed);
    request.set_frames(31);
    *request.mutable_target() = Key("a", 30).pose();
    request.mutable_audio()->set_data(music_);
    return Generate(request);
  }

  /// Three seconds, or quiet ones and three loud ones that repeat them.
  static std::string Song() {
    if (!HearsAll()) return Music(kReturns);
    std::string song = Music(kReturns);
    for (size_t at = 1; at < song.size(); at += 2) song[at] = static_cast<char>(song[at] / 16);
    return song + Music(kReturns);
  }

  static constexpr double kReturns = 3;  // seconds
  const std::string music_ = Song();
  const int64_t frames_ = std::ssize(music_) / 2 / 735;
};

INSTANTIATE_TEST_SUITE_P(, DeterminismTest, testing::Values(Heard::kBeats, Heard::kAllThereIs),
                         [](const auto& tested) {
                           return tested.param == Heard::kBeats ? "Beats" : "AllThereIs";
                         });

TEST_P(DeterminismTest, ChunksDoNotMatter) {
  Start();
  const Answer whole = Stream(3, 1 << 20);
  ASSERT_TRUE(whole.status.ok()) << whole.status.error_message();
  EXPECT_EQ(whole.Join().count, frames_);
  EXPECT_TRUE(whole.Join() == Stream(3, 2 * 1237).Join());
  EXPECT_FALSE(whole.Join() == Stream(4, 1 << 20).Join()) << "the seed does nothing";
}

// The other tests would pass if the music were ignored.
TEST_P(DeterminismTest, AllThatIsHeardMatters) {
  Start();
  const auto stream = [&](const auto& change) {
    DanceClient client(stub());
    v1::DanceConfig config = MusicConfig(3);
    change(&config);
    client.Send(config);
    client.SendAudio(music_, 0);
    client.SendEndOfAudio();
    client.SendKeyframesComplete();
    return client.Finish().Join();
  };
  const Answer::Joined all = stream([](v1::DanceConfig*) {});
  EXPECT_EQ(all.count, frames_);
  EXPECT_FALSE(all == stream([](v1::DanceConfig* config) { config->set_music_beats(1, 1.2); }));
  if (!HearsAll()) return;
  EXPECT_FALSE(all == stream([](v1::DanceConfig* config) { config->set_music_dynamics(0); }));
  EXPECT_FALSE(all == stream([](v1::DanceConfig* config) { config->clear_music_passages(); }));
  EXPECT_FALSE(all == stream([](v1::DanceConfig* config) { config->set_variation(0.5); }));
  EXPECT_FALSE(all == stream([](v1::DanceConfig* config) { config->add_music_energies(1); }));
}

// Sends each message once all frames that were possible before it have come, or all at once.
TEST_P(DeterminismTest, TimingDoesNotMatter) {
  Start();
  const Answer at_once = Stream(3, 2 * 735 * 7);
  ASSERT_TRUE(at_once.status.ok()) << at_once.status.error_message();

  DanceClient client(stub());
  client.Send(MusicConfig(3));
  ASSERT_TRUE(client.ReadHeader());
  client.SendKeyframe(Key("a", 30));
  client.SendKeyframe(SecondKey());
  constexpr size_t kChunk = size_t{2} * 735 * 7;  // seven frames
  const int latency = client.answer().header->latency_frames();
  for (size_t at = 0; at < music_.size(); at += kChunk) {
    client.SendAudio(music_.substr(at, kChunk), static_cast<int64_t>(at / 2));
    const auto heard =
        static_cast<int64_t>(std::min(at + kChunk, music_.size()) / 2 / 735) - latency;
    // Keys grant frames up to the second one.
    ASSERT_TRUE(client.ReadFrames(std::clamp<int64_t>(heard, 0, 71)));
  }
  client.SendEndOfAudio();
  client.SendKeyframesComplete();
  EXPECT_TRUE(client.Finish().Join() == at_once.Join());
}

// Streams and transitions compete with others that have other seeds and chunks.
TEST_P(DeterminismTest, SameBitsAloneAndAmong31Others) {
  constexpr int kCalls = 32;
  Start(/*workers=*/2);
  const Answer stream = Stream(11, 8192);
  const Answer transition = Transition(11);
  ASSERT_TRUE(stream.status.ok()) << stream.status.error_message();
  ASSERT_TRUE(transition.status.ok()) << transition.status.error_message();

  probe->Close();  // until all are there
  std::vector<Answer> answers(kCalls);
  std::vector<std::thread> threads;
  for (int i = 0; i < kCalls; ++i) {
    threads.emplace_back([&, i] {
      const auto seed = static_cast<uint64_t>(i / 2 == 5 ? 11 : 100 + i);
      answers[static_cast<size_t>(i)] =
          i % 2 == 0 ? Stream(seed, 2 * static_cast<size_t>(500 + 321 * i)) : Transition(seed);
    });
  }
  ExpectEventually([this] { return server->transitions() == kCalls; }, "32 transitions");
  probe->Open();
  for (auto& thread : threads) thread.join();
  for (int i = 0; i < kCalls; ++i) {
    const Answer& answer = answers[static_cast<size_t>(i)];
    ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
    EXPECT_EQ(answer.Join() == (i % 2 == 0 ? stream : transition).Join(), i / 2 == 5) << i;
  }
  ExpectIdle();
}

TEST_P(DeterminismTest, ResumedDanceIsTheSame) {
  Start();
  const Answer whole = Stream(21, 1 << 20);
  ASSERT_TRUE(whole.status.ok()) << whole.status.error_message();
  ASSERT_GE(whole.continuations.size(), 2U);
  const v1::Continuation& from = whole.continuations[0];
  EXPECT_EQ(from.frame(), 31);
  EXPECT_EQ(from.audio_from_sample() > 0, !HearsAll());  // energy looks back two minutes

  DanceClient client(stub());
  v1::DanceConfig config = MusicConfig(0);
  config.clear_seed();  // it comes with the continuation
  config.mutable_audio_format()->set_first_sample(from.audio_from_sample());
  *config.mutable_continuation() = from;
  client.Send(config);
  client.SendKeyframe(Key("a", 30));  // was reached before, and is told of again
  client.SendKeyframe(SecondKey());
  client.SendAudio(music_.substr(static_cast<size_t>(2 * from.audio_from_sample())),
                   from.audio_from_sample());
  client.SendEndOfAudio();
  client.SendKeyframesComplete();
  const Answer& resumed = client.Finish();
  ASSERT_TRUE(resumed.status.ok()) << resumed.status.error_message();
  EXPECT_EQ(resumed.header->seed(), 21U);
  EXPECT_EQ(resumed.header->first_frame(), 31);
  EXPECT_EQ(std::count_if(resumed.events.begin(), resumed.events.end(),
                          [](const v1::Event& event) { return event.has_keyframe_reached(); }),
            2);

  const Answer::Joined all = whole.Join();
  const Answer::Joined rest = resumed.Join();
  ASSERT_EQ(rest.first_frame, 31);
  ASSERT_EQ(rest.count, all.count - 31);
  EXPECT_TRUE(std::equal(rest.rotations.begin(), rest.rotations.end(),
                         all.rotations.begin() + std::ptrdiff_t{31} * 72));
  EXPECT_TRUE(std::equal(rest.root_positions.begin(), rest.root_positions.end(),
                         all.root_positions.begin() + std::ptrdiff_t{31} * 3));
}

}  // namespace choreo::determinism_test
