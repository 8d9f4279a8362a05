#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <random>
#include <thread>

#include "tests/server/fixture.h"

namespace choreo::disorder_test {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Ends the program if a test hangs.
class Watchdog {
 public:
  explicit Watchdog(seconds limit)
      : thread_([this, limit] {
          std::unique_lock lock(mutex_);
          if (over_.wait_for(lock, limit, [this] { return done_; })) return;
          std::fprintf(stderr, "the server hangs: not over after %d s\n",
                       static_cast<int>(limit.count()));
          std::abort();
        }) {}
  ~Watchdog() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    over_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable over_;
  bool done_ = false;
  std::jthread thread_;
};

/// The messages of a client, and whether it closes its stream.
struct Script {
  std::vector<v1::StreamDanceRequest> messages;
  bool cancels = false;
};

/// Messages in an order that a seed decides. Most would be valid in another order.
class ScriptWriter {
 public:
  explicit ScriptWriter(uint32_t seed) : random_(seed) {}

  template <class MakeConfig, class MakeKey>
  Script Write(const std::string& music, MakeConfig make_config, MakeKey make_key) {
    Script script;
    v1::StreamDanceRequest config;
    *config.mutable_config() = make_config(Chance(0.6), Chance(0.3) ? Below(200) : -1);
    if (Chance(0.95)) script.messages.push_back(config);
    const int count = Below(12);
    for (int i = 0; i < count; ++i) {
      v1::StreamDanceRequest& next = script.messages.emplace_back();
      switch (Below(20)) {
        case 0:
          break;  // empty
        case 1:
          next = config;
          break;
        case 2:
        case 3:
          next.mutable_end_of_audio();
          break;
        case 4:
        case 5:
          next.mutable_keyframes_complete();
          break;
        case 6:
          next.mutable_remove_keyframe()->set_id(std::to_string(Below(4)));
          break;
        case 7:
        case 8:
        case 9:
        case 10:
          next.mutable_generate_until()->set_frame(Chance(0.1) ? -1 : granted_ += Below(80));
          break;
        case 11:
        case 12:
        case 13:
        case 14:
          *next.mutable_keyframe() = make_key(std::to_string(Below(4)), Below(240));
          break;
        default: {
          const size_t at = std::min<size_t>(sent_, music.size());
          const size_t size = std::min<size_t>(2 * Below(30'000), music.size() - at);
          next.mutable_audio()->set_data(music.substr(at, size));
          next.mutable_audio()->set_first_sample(static_cast<int64_t>(at / 2) + Chance(0.03));
          sent_ += size;
        }
      }
    }
    script.cancels = Chance(0.2);
    return script;
  }

 private:
  int Below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }
  bool Chance(double share) { return std::bernoulli_distribution(share)(random_); }

  std::mt19937 random_;
  int64_t granted_ = 0;
  size_t sent_ = 0;
};

class DisorderTest : public ServerTest {
 protected:
  static constexpr milliseconds kPatience{30'000};

  Script WriteScript(uint32_t seed) const {
    return ScriptWriter(seed).Write(
        music_,
        [](bool music, int frames) {
          v1::DanceConfig config = Config();
          if (music) *config.mutable_audio_format() = MusicFormat();
          if (frames >= 0) config.set_frames(frames);
          return config;
        },
        [](const std::string& id, int frame) { return Key(id, frame); });
  }

  Answer Play(const Script& script) {
    DanceClient client(stub(), kPatience);
    for (const auto& message : script.messages) {
      if (!client.Send(message)) break;
    }
    return script.cancels ? client.Cancel() : client.Finish();
  }

  // Checks that a stream ended in one of the allowed ways.
  static void ExpectAnAnswer(const Script& script, const Answer& answer) {
    switch (answer.status.error_code()) {
      case grpc::StatusCode::OK:
        ASSERT_TRUE(answer.summary);
        EXPECT_EQ(answer.Join().count, answer.summary->report().frames());
        break;
      case grpc::StatusCode::CANCELLED:
        EXPECT_TRUE(script.cancels) << answer.status.error_message();
        break;
      case grpc::StatusCode::INVALID_ARGUMENT:
      case grpc::StatusCode::OUT_OF_RANGE:
      case grpc::StatusCode::NOT_FOUND:
      case grpc::StatusCode::FAILED_PRECONDITION:
        EXPECT_TRUE(DetailsOf(answer.status).bad_request) << answer.status.error_message();
        break;
      default:
        ADD_FAILURE() << answer.status.error_code() << ": " << answer.status.error_message();
    }
  }

  const std::string music_ = Music(4);
};

// No music has come, so the end of the dance is unknown.
TEST_F(DisorderTest, PacingAfterTheLastKeyIsHarmless) {
  const Watchdog watchdog(seconds(60));
  Start(/*workers=*/2);
  DanceClient client(stub());
  v1::DanceConfig config = Config();
  *config.mutable_audio_format() = MusicFormat();
  client.Send(config);
  client.SendKeyframesComplete();
  client.SendGenerateUntil(0);
  client.SendGenerateUntil(20);
  client.SendAudio(music_, 0);
  client.SendGenerateUntil(40);
  const Answer& answer = client.Finish();
  ASSERT_TRUE(answer.status.ok()) << answer.status.error_message();
  EXPECT_EQ(answer.Join().count, 120);
  ExpectIdle();
}

// Four at once on two workers, because a stream's answers must not depend on the others.
TEST_F(DisorderTest, MessagesInAnyOrderEndInAnAnswer) {
  const Watchdog watchdog(seconds(240));
  Start(/*workers=*/2);
  constexpr uint32_t kClients = 4;
  constexpr uint32_t kScripts = 100;
  std::atomic<int> danced = 0, twice = 0;
  std::vector<std::jthread> clients;
  for (uint32_t client = 0; client < kClients; ++client) {
    clients.emplace_back([&, client] {
      for (uint32_t i = 0; i < kScripts; ++i) {
        const uint32_t seed = client * kScripts + i;
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Script script = WriteScript(seed);
        const Answer answer = Play(script);
        ExpectAnAnswer(script, answer);
        if (!answer.status.ok()) continue;
        ++danced;
        const Answer again = Play(script);
        ExpectAnAnswer(script, again);
        // Timing decides whether a dance ends before it is cancelled, or before a refused message
        // arrives.
        if (!again.status.ok()) continue;
        EXPECT_TRUE(again.Join() == answer.Join()) << "the same messages, another dance";
        ++twice;
      }
    });
  }
  clients.clear();
  ExpectIdle();
  std::cout << kClients * kScripts << " orders of messages: " << danced << " danced to their end, "
            << twice
            << " of these twice and the same; the others were cancelled, or told what is wrong\n";
}

}  // namespace choreo::disorder_test
