#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <thread>
#include <vector>

#include "client/authoring/local_server.h"
#include "client/choreo_client.h"
#include "tests/support/eventually.h"
#include "tests/support/setting.h"

/// Many dances in real time on three replicas, of which one after another is killed or falls
/// silent. CHOREO_FAULT_STREAMS and CHOREO_FAULT_SECONDS make it longer (scripts/faults.sh).
namespace choreo::client::replica_fault_test {

using authoring::LocalServer;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kReplicas = 3;
constexpr double kFps = 30;
constexpr milliseconds kGrant{100};      // a grant comes that often
constexpr milliseconds kBetween{2'000};  // two losses
constexpr milliseconds kAway{1'000};     // until who was killed is back
constexpr milliseconds kSilent{4'000};

class Fleet {
 public:
  Fleet() {
    ::setenv("CHOREO_MAX_STREAMS", "1000", 1);  // all of them may come to one
    for (auto& replica : replicas_) replica = std::make_unique<LocalServer>(FAKE_CHOREOD);
    ::unsetenv("CHOREO_MAX_STREAMS");
    for (const auto& replica : replicas_) addresses_.push_back(replica->address());
  }
  /// The replicas' addresses, with another one first for each `turn`.
  std::vector<std::string> Addresses(int turn) const {
    std::vector<std::string> turned = addresses_;
    std::ranges::rotate(turned, turned.begin() + turn % kReplicas);
    return turned;
  }
  /// Kills a replica, and restarts it after a while.
  void Kill(int which) {
    auto& replica = replicas_[static_cast<size_t>(which)];
    ASSERT_EQ(::kill(replica->process(), SIGKILL), 0);
    std::this_thread::sleep_for(kAway);
    replica.reset();
    ::setenv("CHOREO_MAX_STREAMS", "1000", 1);
    replica = std::make_unique<LocalServer>(FAKE_CHOREOD, addresses_[static_cast<size_t>(which)]);
  }
  /// Stops a replica's process for a while.
  void Silence(int which) {
    const pid_t process = replicas_[static_cast<size_t>(which)]->process();
    ASSERT_EQ(::kill(process, SIGSTOP), 0);
    std::this_thread::sleep_for(kSilent);
    ASSERT_EQ(::kill(process, SIGCONT), 0);
  }

 private:
  std::unique_ptr<LocalServer> replicas_[kReplicas];
  std::vector<std::string> addresses_;
};

struct Danced {
  std::vector<Pose> frames;
  std::vector<double> recoveries;  // seconds without a frame, where its server was lost
};

DanceConfig ConfigOf(int stream, int64_t frames) {
  return {.seed = static_cast<uint64_t>(stream), .frames = frames, .generate_until = 0};
}

Danced Read(RemoteDance& dance) {
  Danced danced;
  Clock::time_point last = Clock::now();
  bool lost = false;
  while (const std::optional<Message> message = dance.Next()) {
    if (std::holds_alternative<Resumed>(*message)) lost = true;
    const auto* block = std::get_if<FrameBlock>(&*message);
    if (block == nullptr) continue;
    danced.frames.insert(danced.frames.end(), block->poses.begin(), block->poses.end());
    const Clock::time_point now = Clock::now();
    if (std::exchange(lost, false)) {
      danced.recoveries.push_back(std::chrono::duration<double>(now - last).count());
    }
    last = now;
  }
  return danced;
}

TEST(ReplicaFaultTest, EveryDanceSurvivesTheLossOfReplicas) {
  const int streams = Setting("CHOREO_FAULT_STREAMS", 12);
  const int seconds = Setting("CHOREO_FAULT_SECONDS", 7);
  const auto frames = static_cast<int64_t>(seconds * kFps);
  Fleet fleet;
  std::vector<std::unique_ptr<Client>> clients;
  std::vector<std::unique_ptr<RemoteDance>> dances;
  for (int i = 0; i < streams; ++i) {
    clients.push_back(std::make_unique<Client>(Options{.addresses = fleet.Addresses(i),
                                                       .connect_timeout_s = 1,
                                                       .silence_s = 2,
                                                       .retry_s = 250,
                                                       .first_backoff_s = 0.01}));
    dances.push_back(clients.back()->StartDance(ConfigOf(i, frames)));
  }
  std::vector<Danced> danced(dances.size());
  int losses = 0;
  {
    std::vector<std::jthread> readers;
    for (size_t i = 0; i < dances.size(); ++i) {
      readers.emplace_back([&, i] { danced[i] = Read(*dances[i]); });
    }
    std::jthread pace([&] {
      const Clock::time_point begin = Clock::now();
      for (int64_t granted = 0; granted < frames;) {
        std::this_thread::sleep_for(kGrant);
        const double passed = std::chrono::duration<double>(Clock::now() - begin).count();
        granted = std::min(frames, static_cast<int64_t>(passed * kFps));
        for (const auto& dance : dances) dance->GenerateUntil(granted);
      }
      for (const auto& dance : dances) dance->CompleteKeys();
    });
    const Clock::time_point end = Clock::now() + std::chrono::seconds(seconds) - kBetween;
    for (; Clock::now() < end; ++losses) {
      std::this_thread::sleep_for(kBetween - kAway);
      losses % 4 == 1 ? fleet.Silence(losses % kReplicas) : fleet.Kill(losses % kReplicas);
    }
  }

  std::vector<double> recoveries;
  const Client undisturbed({.addresses = fleet.Addresses(0)});
  for (int i = 0; i < streams; ++i) {
    const Danced& one = danced[static_cast<size_t>(i)];
    const auto dance = undisturbed.StartDance(ConfigOf(i, frames));
    dance->CompleteKeys();
    const Danced wanted = Read(*dance);
    ASSERT_EQ(one.frames.size(), wanted.frames.size()) << "dance " << i;
    for (size_t at = 0; at < wanted.frames.size(); ++at) {
      ASSERT_EQ(one.frames[at].root_position, wanted.frames[at].root_position) << i << ' ' << at;
      ASSERT_EQ(one.frames[at].rotations, wanted.frames[at].rotations) << i << ' ' << at;
    }
    recoveries.insert(recoveries.end(), one.recoveries.begin(), one.recoveries.end());
  }
  ASSERT_FALSE(recoveries.empty()) << "nobody lost a server";
  std::ranges::sort(recoveries);
  const auto quantile = [&](double share) {
    return recoveries[static_cast<size_t>(share * static_cast<double>(recoveries.size() - 1))];
  };
  std::cout << streams << " dances of " << seconds << " s, " << losses << " servers lost, "
            << recoveries.size() << " times a dance went on elsewhere: without a frame for p50 "
            << quantile(0.5) << " s, p99 " << quantile(0.99) << " s; all as undisturbed\n";
}

TEST(ReplicaFaultTest, TerminatedReplicaHandsOverAndExitsWithZero) {
  LocalServer leaving(FAKE_CHOREOD);
  const LocalServer heir(FAKE_CHOREOD);
  const Client client({.addresses = {leaving.address(), heir.address()}, .retry_s = 250});
  constexpr int64_t kFrames = 300;
  const auto dance = client.StartDance(ConfigOf(1, kFrames));
  dance->GenerateUntil(150);
  Danced danced;
  while (danced.frames.size() < 150) {
    const std::optional<Message> message = dance->Next();
    ASSERT_TRUE(message);
    if (const auto* block = std::get_if<FrameBlock>(&*message))
      danced.frames.insert(danced.frames.end(), block->poses.begin(), block->poses.end());
  }
  ::kill(leaving.process(), SIGTERM);
  dance->CompleteKeys();
  const Danced rest = Read(*dance);
  danced.frames.insert(danced.frames.end(), rest.frames.begin(), rest.frames.end());
  const auto again = Client({.addresses = {heir.address()}}).StartDance(ConfigOf(1, kFrames));
  again->CompleteKeys();
  const Danced wanted = Read(*again);
  ASSERT_EQ(danced.frames.size(), wanted.frames.size());
  for (size_t i = 0; i < wanted.frames.size(); ++i) {
    ASSERT_EQ(danced.frames[i].rotations, wanted.frames[i].rotations) << i;
  }
  std::string end;
  const bool has_ended = Eventually([&] {
    try {
      leaving.RequireRunning();
    } catch (const Error& error) {
      end = error.what();
    }
    return !end.empty();
  });
  EXPECT_TRUE(has_ended);
  EXPECT_NE(end.find("exit code 0"), std::string::npos) << end;
}

}  // namespace choreo::client::replica_fault_test
