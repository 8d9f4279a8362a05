#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <iostream>
#include <map>
#include <optional>
#include <string>

#include "model/core/error.h"
#include "server/connections/listener.h"
#include "tests/server/connections/silent_connections.h"
#include "tests/support/eventually.h"

namespace choreo::descriptors_test {

using authoring::LocalServer;

/// Limits descriptors of this process and its children during its lifetime.
class DescriptorLimit {
 public:
  explicit DescriptorLimit(rlim_t count) {
    getrlimit(RLIMIT_NOFILE, &before_);
    rlimit lower = before_;
    lower.rlim_cur = count;
    setrlimit(RLIMIT_NOFILE, &lower);
  }
  ~DescriptorLimit() { setrlimit(RLIMIT_NOFILE, &before_); }
  DescriptorLimit(const DescriptorLimit&) = delete;
  DescriptorLimit& operator=(const DescriptorLimit&) = delete;

 private:
  rlimit before_{};
};

// More clients connect than the server has descriptors for. The surplus is refused, and once the
// others have left it serves as before.
TEST(DescriptorsTest, AreFreedAfterTooManyConnections) {
  constexpr int kDescriptors = 200;
  constexpr int kConnections = 260;
  std::optional<LocalServer> server;
  {
    const DescriptorLimit limit(kDescriptors);
    server.emplace(FAKE_CHOREOD);
  }
  for (int round = 0; round < 2; ++round) {
    {
      const SilentConnections silent(server->address(), kConnections);
      int closed = 0;
      EXPECT_TRUE(Eventually([&] {
        closed = silent.Closed();
        return closed >= kConnections - (kDescriptors - 64);
      })) << closed
          << " sent away";
      EXPECT_LT(closed, kConnections - 50) << "the others stay";
      EXPECT_FALSE(Serves(*server)) << "there is no room";
    }
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(Eventually([&] { return Serves(*server); })) << "in round " << round;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    std::cout << "it serves " << took.count() << " s after " << kConnections
              << " connections have gone\n";
  }
}

TEST(DescriptorsTest, TheLimitIsRaisedAsFarAsAllowed) {
  const DescriptorLimit limit(100);
  RaiseDescriptorLimit();
  rlimit raised{};
  getrlimit(RLIMIT_NOFILE, &raised);
  EXPECT_EQ(raised.rlim_cur, raised.rlim_max);
}

TEST(ListenerTest, TakesEveryAddressOfAHostWithOnePort) {
  for (const char* address : {"127.0.0.1:0", "localhost:0", "0.0.0.0:0"}) {
    Listener listener(address);
    EXPECT_GT(listener.port(), 0) << address;
    const SilentConnections one("127.0.0.1:" + std::to_string(listener.port()), 1);
  }
}

TEST(ListenerTest, NamesAnUnusableAddress) {
  const Listener taken("127.0.0.1:0");
  // An address of another machine is a wrong setting. So is no name of a host.
  const std::map<std::string, ErrorCode> addresses = {
      {"127.0.0.1:" + std::to_string(taken.port()), ErrorCode::kUnavailable},
      {"203.0.113.1:0", ErrorCode::kInvalidArgument},
      {"no+host:0", ErrorCode::kInvalidArgument}};
  for (const auto& [address, code] : addresses) {
    try {
      const Listener listener(address);
      ADD_FAILURE() << address;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << address;
      EXPECT_NE(std::string(error.what()).find(address), std::string::npos) << error.what();
    }
  }
}

TEST(ListenerTest, HandsConnectionsOnUntilItStops) {
  Listener listener("127.0.0.1:0");
  const std::string address = "127.0.0.1:" + std::to_string(listener.port());
  const SilentConnections early(address, 1);  // waits
  std::atomic<int> taken = 0;
  listener.Start([&](int, int connection) {
    close(connection);
    ++taken;
  });
  const SilentConnections later(address, 3);
  EXPECT_TRUE(Eventually([&] { return taken == 4; }));
  listener.Stop();
  listener.Stop();
  EXPECT_TRUE(Eventually([&] { return early.Closed() + later.Closed() == 4; }));
}

}  // namespace choreo::descriptors_test
