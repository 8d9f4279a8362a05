#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <optional>
#include <thread>
#include <vector>

#include "client/authoring/local_server.h"
#include "client/choreo_client.h"
#include "tests/support/bad_wire.h"
#include "tests/support/eventually.h"
#include "tests/support/expect_error.h"
#include "tests/support/setting.h"

/// A server behind a network that loses, delays and reorders packets, or fails for a while.
/// CHOREO_FAULT_SECONDS makes the dances longer (scripts/faults.sh).
namespace choreo::client::network_test {

using authoring::LocalServer;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr double kFps = 30;
constexpr milliseconds kGrant{100};

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class NetworkTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!BadWire::MayMake()) return;
    ::setenv("CHOREO_INSECURE", "true", 1);
    ::setenv("CHOREO_IDLE_SECONDS", "4", 1);
    ::setenv("CHOREO_MAX_STREAMS", "4", 1);
    wire_ = new BadWire(
        [] { server_ = new LocalServer(FAKE_CHOREOD, std::string(BadWire::kFar) + ":0"); });
    const std::string said = server_->address();
    address_ = BadWire::kFar + said.substr(said.rfind(':'));
  }
  static void TearDownTestSuite() {
    delete server_;
    delete wire_;
  }
  void SetUp() override {
    if (wire_ == nullptr) GTEST_SKIP() << "only root may make network namespaces";
    wire_->Be({});
  }

  static Options ClientOptions(double retry_s) {
    return {.addresses = {address_}, .connect_timeout_s = 2, .silence_s = 2, .retry_s = retry_s};
  }

  struct Danced {
    std::vector<Pose> frames;
    double longest_pause_s = 0;
    int resumes = 0;
  };

  // Reads to the end. Calls `at_half` once half of the frames have come.
  static Danced Read(RemoteDance& dance, int64_t frames,
                     const std::function<void()>& at_half = {}) {
    Danced danced;
    auto last = Clock::now();
    while (const std::optional<Message> message = dance.Next()) {
      if (std::holds_alternative<Resumed>(*message)) ++danced.resumes;
      const auto* block = std::get_if<FrameBlock>(&*message);
      if (block == nullptr) continue;
      danced.longest_pause_s = std::max(danced.longest_pause_s, SecondsSince(last));
      last = Clock::now();
      const bool before_half = std::ssize(danced.frames) < frames / 2;
      danced.frames.insert(danced.frames.end(), block->poses.begin(), block->poses.end());
      if (at_half && before_half && std::ssize(danced.frames) >= frames / 2) at_half();
    }
    return danced;
  }

  // Dances with one grant for all frames.
  static Danced Dance(uint64_t seed, int64_t frames) {
    const Client client(ClientOptions(250));
    const auto dance = client.StartDance({.seed = seed, .frames = frames});
    dance->CompleteKeys();
    return Read(*dance, frames);
  }

  // Dances with grants in real time.
  static Danced DanceInTime(uint64_t seed, int64_t frames) {
    const Client client(ClientOptions(250));
    const auto dance = client.StartDance({.seed = seed, .frames = frames, .generate_until = 0});
    const std::jthread pace([&] {
      const auto begin = Clock::now();
      for (int64_t granted = 0; granted < frames;) {
        std::this_thread::sleep_for(kGrant);
        granted = std::min(frames, static_cast<int64_t>(SecondsSince(begin) * kFps));
        dance->GenerateUntil(granted);
      }
      dance->CompleteKeys();
    });
    return Read(*dance, frames);
  }

  static void ExpectSame(const Danced& danced, const Danced& wanted) {
    ASSERT_EQ(danced.frames.size(), wanted.frames.size());
    for (size_t i = 0; i < wanted.frames.size(); ++i) {
      ASSERT_EQ(danced.frames[i].root_position, wanted.frames[i].root_position) << "frame " << i;
      ASSERT_EQ(danced.frames[i].rotations, wanted.frames[i].rotations) << "frame " << i;
    }
  }

  static inline BadWire* wire_ = nullptr;
  static inline LocalServer* server_ = nullptr;
  static inline std::string address_;
};

TEST_F(NetworkTest, LossDelayAndDisorderChangeNothing) {
  const auto frames = static_cast<int64_t>(kFps * Setting("CHOREO_FAULT_SECONDS", 6));
  const Danced wanted = Dance(1, frames);
  const int64_t passed = wire_->passed(), lost = wire_->lost();
  wire_->Be({.loss = 0.03, .delay = milliseconds(40), .spread = milliseconds(30)});
  const Danced danced = DanceInTime(1, frames);
  wire_->Be({});
  ExpectSame(danced, wanted);
  EXPECT_GT(wire_->lost(), lost) << "nothing was lost";
  std::cout << frames << " frames, packets 40 to 70 ms late: " << wire_->lost() - lost << " lost, "
            << wire_->passed() - passed << " passed; longest without a frame "
            << danced.longest_pause_s << " s, " << danced.resumes
            << " resumes; bits as undisturbed\n";
}

// Until its client has missed it, and has called in vain.
TEST_F(NetworkTest, DanceContinuesAfterACutLink) {
  constexpr int64_t kFrames = 240;
  const Danced wanted = Dance(2, kFrames);
  Options options = ClientOptions(250);
  int retries = 0;
  options.before_retry = [&] {
    if (++retries == 2) wire_->Be({});
  };
  const auto dance =
      Client(options).StartDance({.seed = 2, .frames = kFrames, .generate_until = kFrames / 2});
  const Danced danced = Read(*dance, kFrames, [&] {
    wire_->Cut();
    dance->CompleteKeys();
  });
  ExpectSame(danced, wanted);
  EXPECT_GE(retries, 2) << "the link was not missed";
  EXPECT_GT(danced.resumes, 0);
  std::cout << "cut until the client had called in vain: " << danced.longest_pause_s
            << " s without a frame, " << danced.resumes << " resumes; bits as undisturbed\n";
}

TEST_F(NetworkTest, ReportsALinkThatIsLostForGood) {
  const Client client(ClientOptions(/*retry_s=*/3));
  const auto dance = client.StartDance({.seed = 3, .frames = 300, .generate_until = 0});
  dance->GenerateUntil(10);
  for (size_t frames = 0; frames < 10;) {
    const std::optional<Message> message = dance->Next();
    ASSERT_TRUE(message);
    if (const auto* block = std::get_if<FrameBlock>(&*message)) frames += block->poses.size();
  }
  wire_->Cut();
  const auto begin = Clock::now();
  ExpectError(ErrorCode::kUnavailable, "", [&] {
    while (dance->Next()) continue;
  });
  std::cout << "cut for good: told after " << SecondsSince(begin) << " s\n";
}

// More calls than places: the places of unreachable clients become free again.
TEST_F(NetworkTest, UnreachableClientsFreeTheirPlaces) {
  constexpr int kCalls = 6;
  for (int i = 0; i < kCalls; ++i) {
    const Client client(ClientOptions(/*retry_s=*/30));
    const auto dance = client.StartDance({.seed = 4, .frames = 300, .generate_until = 0});
    dance->GenerateUntil(10);
    bool begun = false;
    while (!begun) {
      const std::optional<Message> message = dance->Next();
      ASSERT_TRUE(message) << "call " << i;
      begun = std::holds_alternative<FrameBlock>(*message);
    }
    wire_->Cut();
    const int64_t lost = wire_->lost();
    dance->Cancel();  // which nobody hears
    EXPECT_TRUE(Eventually([&] { return wire_->lost() > lost; }));
    wire_->Be({});
  }
}

}  // namespace choreo::client::network_test
