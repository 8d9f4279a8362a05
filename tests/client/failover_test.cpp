#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <iostream>
#include <regex>
#include <sstream>

#include "client/choreo_client.h"
#include "tests/client/test_server.h"
#include "tests/support/expect_error.h"
#include "tests/support/tcp_proxy.h"

/// Replicas that answer, but refuse calls or delay them.
namespace choreo::client::failover_test {

Options Replicas(std::vector<std::string> addresses) {
  Options options;
  options.addresses = std::move(addresses);
  options.first_backoff_s = 0.01;
  return options;
}

struct Danced {
  Motion motion;
  std::vector<Resumed> resumed;
};

/// Free dancing for 250 frames: three transitions and more. `between` is called at the first
/// continuation.
Danced Dance(const Client& client, const std::function<void()>& between = {}) {
  const auto dance = client.StartDance({.seed = 4, .frames = 250});
  dance->GenerateUntil(120);
  Danced danced;
  bool first = true;
  while (const std::optional<Message> message = dance->Next()) {
    if (const auto* block = std::get_if<FrameBlock>(&*message)) {
      danced.motion.frames.insert(danced.motion.frames.end(), block->poses.begin(),
                                  block->poses.end());
    } else if (const auto* resumed = std::get_if<Resumed>(&*message)) {
      danced.resumed.push_back(*resumed);
    } else if (std::holds_alternative<Continuation>(*message) && first) {
      first = false;
      if (between) between();
      dance->CompleteKeys();
    }
  }
  return danced;
}

void ExpectSame(const Motion& a, const Motion& b) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (size_t i = 0; i < a.frames.size(); ++i) {
    ASSERT_EQ(a.frames[i].root_position, b.frames[i].root_position) << "frame " << i;
    ASSERT_EQ(a.frames[i].rotations, b.frames[i].rotations) << "frame " << i;
  }
}

Motion Undisturbed() {
  TestServer server;
  return Dance(Client(Replicas({server.address()}))).motion;
}

TEST(FailoverTest, SkipsAReplicaOfAnotherFingerprint) {
  TestServer dying;
  TestServer other("fake-2");
  TestServer heir;
  const Danced danced = Dance(Client(Replicas({dying.address(), other.address(), heir.address()})),
                              [&] { dying.Die(); });
  ExpectSame(danced.motion, Undisturbed());
  ASSERT_EQ(danced.resumed.size(), 1U);
  EXPECT_EQ(danced.resumed[0].address, heir.address());
  EXPECT_TRUE(danced.resumed[0].exact);
}

// A reader of the logs can follow the dance.
TEST(FailoverTest, TheLogsNameTheCallInWhichTheDanceBegan) {
  const auto before = spdlog::default_logger();
  std::ostringstream log;
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "log", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)));
  {
    TestServer dying, heir;
    Dance(Client(Replicas({dying.address(), heir.address()})), [&] { dying.Die(); });
  }
  spdlog::set_default_logger(before);
  const std::string said = log.str();
  std::smatch first;
  ASSERT_TRUE(std::regex_search(said, first, std::regex(" stream ([0-9a-f]{16}): UNAVAILABLE")));
  EXPECT_THAT(said, testing::ContainsRegex("resumes stream " + first[1].str() + " at frame"));
  EXPECT_THAT(said, testing::HasSubstr(" from " + first[1].str() + ": OK"));
}

// The dead replica is restarted meanwhile.
TEST(FailoverTest, ReturnsToAReplicaOfTheSameFingerprint) {
  auto first = std::make_unique<TestServer>();
  const std::string address = first->address();
  TestServer other("fake-2");
  Options options = Replicas({address, other.address()});
  options.retry_s = 60;
  int tries = 0;
  options.before_retry = [&] {
    if (++tries == 5) first = std::make_unique<TestServer>("fake-1", address);
  };
  const Danced danced = Dance(Client(options), [&] { first.reset(); });
  ExpectSame(danced.motion, Undisturbed());
  ASSERT_EQ(danced.resumed.size(), 1U);
  EXPECT_EQ(danced.resumed[0].address, address);
}

TEST(FailoverTest, EndsWithTheReasonOfReachableReplicas) {
  TestServer dying;
  TestServer other("fake-2");
  Options options = Replicas({dying.address(), other.address()});
  options.retry_s = 0.3;
  ExpectError(ErrorCode::kFailedPrecondition, "fake-2",
              [&] { Dance(Client(options), [&] { dying.Die(); }); });
}

TEST(FailoverTest, EndsOnceAllHaveRefused) {
  TestServer one("fake-1");
  TestServer other("fake-2");
  DanceConfig config{.frames = 200};
  Continuation ended;
  const auto dance = Client(Replicas({one.address()})).StartDance(config);
  dance->CompleteKeys();
  while (const std::optional<Message> message = dance->Next()) {
    if (const auto* continuation = std::get_if<Continuation>(&*message)) ended = *continuation;
  }
  TestServer third("fake-3");
  Options options = Replicas({other.address(), third.address()});
  options.retry_s = 1e6;  // no reason to wait for that
  config = {.continuation = ended, .frames = 300};
  ExpectError(ErrorCode::kFailedPrecondition, "fake-3",
              [&] { Client(options).Dance(config, {}, {}); });
}

TEST(FailoverTest, InternalAtOneReplicaIsTriedAtAnother) {
  TestServer breaking(std::make_unique<BreakingSampler>(130));
  TestServer sound;
  const Danced danced = Dance(Client(Replicas({breaking.address(), sound.address()})));
  ExpectSame(danced.motion, Undisturbed());
  ASSERT_EQ(danced.resumed.size(), 1U);
  EXPECT_EQ(danced.resumed[0].address, sound.address());
  EXPECT_EQ(danced.resumed[0].reason, "the device is gone");

  TestServer broken(std::make_unique<BreakingSampler>(5));
  const TransitionRequest request{.config = {.seed = 1}, .frames = 10};
  TestServer alone(std::make_unique<BreakingSampler>(5));
  Options once = Replicas({alone.address()});
  once.retry_s = 0;
  ExpectError(ErrorCode::kInternal, "the device is gone",
              [&] { Client(once).GenerateTransition(request); });
  EXPECT_EQ(Client(Replicas({broken.address(), sound.address()}))
                .GenerateTransition(request)
                .candidates.front()
                .motion.frames.size(),
            10U);
}

// A name with several addresses, as a headless service has.
TEST(FailoverTest, RotatesThroughTheAddressesOfAName) {
  TestServer one;
  TestServer other;
  const Client client(Replicas({"ipv4:" + one.address() + ',' + other.address()}));
  EXPECT_TRUE(client.IsServing());
  std::vector<std::unique_ptr<RemoteDance>> dances;
  // Connections come one after the other: at first there may be only one.
  for (int i = 0; i < 1000 && (one.calls() == 0 || other.calls() == 0); ++i) {
    dances.push_back(client.StartDance({.frames = 30}));
    ASSERT_TRUE(dances.back()->Next());
    if (dances.size() > 20) dances.erase(dances.begin());
  }
  EXPECT_GT(one.calls(), 0);
  EXPECT_GT(other.calls(), 0);
}

TEST(FailoverTest, SkipsADrainingAddress) {
  TestServer leaving;
  TestServer staying;
  const auto dance = Client(Replicas({leaving.address()})).StartDance({.frames = 30});
  ASSERT_TRUE(dance->Next());  // it keeps the server from leaving
  Options options = Replicas({"ipv4:" + leaving.address() + ',' + staying.address()});
  const Client client(options);
  std::jthread drain([&] { leaving.Drain(300); });
  while (Client(Replicas({leaving.address()})).IsServing()) std::this_thread::yield();
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(client.Dance({.frames = 20}, {}, {}).motion.frames.size(), 20U);
  }
  dance->Cancel();
  std::cout << "20 dances passed it\n";
}

// Packets are lost without an error. The client goes to the next replica within seconds.
TEST(FailoverTest, LeavesASilentNetwork) {
  TestServer cut;
  TestServer heir;
  TcpProxy network(cut.port());
  Options options = Replicas({network.address(), heir.address()});
  options.silence_s = 2;
  options.retry_s = 0.5;  // since it was noticed
  std::chrono::steady_clock::time_point begin;
  const Danced danced = Dance(Client(options), [&] {
    network.FallSilent();
    begin = std::chrono::steady_clock::now();
  });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::cout << "silence of 2 s is allowed: the dance was over elsewhere after " << took.count()
            << " s\n";
  ExpectSame(danced.motion, Undisturbed());
  ASSERT_EQ(danced.resumed.size(), 1U);
  EXPECT_EQ(danced.resumed[0].address, heir.address());
}

// A server without anything to send still answers pings, so waiting does not count as silence.
TEST(FailoverTest, LetsADancePauseLongerThanSilence) {
  TestServer server;
  Options options = Replicas({server.address()});
  options.silence_s = 2;
  const Danced danced =
      Dance(Client(options), [] { std::this_thread::sleep_for(std::chrono::milliseconds(3'000)); });
  EXPECT_EQ(danced.motion.frames.size(), 250U);
  EXPECT_TRUE(danced.resumed.empty());
}

TEST(FailoverTest, SilenceIsNotShorterThanServersArePinged) {
  ExpectError(ErrorCode::kInvalidArgument, "silence_s", [] { Client({.silence_s = 1}); });
}

}  // namespace choreo::client::failover_test
