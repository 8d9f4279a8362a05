#include "server/calls/call_registry.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "server/messages/refusal.h"
#include "tests/support/advanced_clock.h"

/// Which callers get a server's places, and when refused callers should retry.
namespace choreo::call_registry_test {

struct SilentCall final : Call {
  void End(const Error& /*error*/, Ending /*ending*/) override {}
  void EndIfRevoked() override {}
  void GiveUp() noexcept override {}
  CallProgress progress() const override { return {}; }
};

class CallRegistryTest : public testing::Test {
 protected:
  static constexpr int kCalls = 4, kOfPeer = 3;

  bool Come(const std::string& caller) { return !RefusalOf(caller); }
  std::optional<Refusal> RefusalOf(const std::string& caller) {
    const auto call = std::make_shared<SilentCall>();
    try {
      registry.Enter(call, caller);
      registry.Admit(call.get());
    } catch (const Refused& refused) {
      registry.Leave(call.get());
      return refused.why();
    }
    calls.push_back(call);
    return std::nullopt;
  }
  void LeaveOne() {
    registry.Leave(calls.front().get());
    calls.erase(calls.begin());
  }

  AdvancedClock clock;
  CallRegistry registry{
      {.calls = kCalls, .calls_of_caller = kOfPeer, .calls_of_lone_caller = kCalls}, clock};
  std::vector<std::shared_ptr<SilentCall>> calls;
};

TEST_F(CallRegistryTest, LimitsMayChangeMeanwhile) {
  for (int i = 0; i < kCalls; ++i) EXPECT_TRUE(Come("ipv4:10.0.0.1"));
  EXPECT_FALSE(Come("ipv4:10.0.0.1"));
  registry.SetLimits(
      {.calls = kCalls + 1, .calls_of_caller = 1, .calls_of_lone_caller = kCalls + 1});
  EXPECT_TRUE(Come("ipv4:10.0.0.1"));
  registry.SetLimits({.calls = 1, .calls_of_caller = 1, .calls_of_lone_caller = 1});
  EXPECT_EQ(registry.count(), kCalls + 1) << "who is there stays";
  EXPECT_FALSE(Come("ipv4:10.0.0.1"));
}

TEST_F(CallRegistryTest, CallersHaveTheirOwnPlaces) {
  for (int i = 0; i < kOfPeer - 1; ++i) EXPECT_TRUE(Come("ipv4:10.0.0.1"));
  EXPECT_TRUE(Come("ipv6:[::1]"));
  EXPECT_TRUE(Come("ipv4:10.0.0.1"));
  EXPECT_EQ(RefusalOf("ipv4:10.0.0.1"), Refusal::kStreamsOfPeer);
  EXPECT_EQ(RefusalOf("ipv4:10.0.0.2"), Refusal::kStreams);
  LeaveOne();
  EXPECT_TRUE(Come("ipv4:10.0.0.2"));
  EXPECT_EQ(registry.count(), kCalls);
  while (!calls.empty()) LeaveOne();
  EXPECT_EQ(registry.count(), 0);
  EXPECT_TRUE(registry.WaitUntilEmpty(std::chrono::milliseconds(0)));
}

TEST_F(CallRegistryTest, ALoneCallerMayHaveAllPlaces) {
  for (int i = 0; i < kCalls; ++i) EXPECT_TRUE(Come("alice"));
  EXPECT_EQ(RefusalOf("alice"), Refusal::kStreams) << "no share is what alice lacks";
  EXPECT_EQ(registry.utilisation(), 1);
}

TEST_F(CallRegistryTest, WhoWasRefusedFindsThePlaceThatGetsFree) {
  for (int i = 0; i < kCalls; ++i) EXPECT_TRUE(Come("alice"));
  EXPECT_FALSE(Come("bob"));
  LeaveOne();
  EXPECT_FALSE(Come("alice"));
  EXPECT_TRUE(Come("bob"));
  LeaveOne();
  EXPECT_TRUE(Come("alice"));
  EXPECT_FALSE(Come("alice"));
}

TEST_F(CallRegistryTest, AFormerCallersPlaceIsKeptForAMinute) {
  EXPECT_TRUE(Come("bob"));
  LeaveOne();
  for (int i = 0; i < kOfPeer; ++i) EXPECT_TRUE(Come("alice"));
  clock.Advance(std::chrono::seconds(59));
  EXPECT_EQ(RefusalOf("alice"), Refusal::kStreamsOfPeer);
  clock.Advance(std::chrono::seconds(2));
  EXPECT_TRUE(Come("alice"));
}

TEST_F(CallRegistryTest, UtilisationIsTheBusiestCallers) {
  EXPECT_EQ(registry.utilisation(), 0);
  EXPECT_TRUE(Come("bob"));
  EXPECT_EQ(registry.utilisation(), 1.0 / kCalls);
  LeaveOne();
  for (int i = 0; i < kOfPeer; ++i) EXPECT_TRUE(Come("alice"));
  EXPECT_EQ(registry.utilisation(), 1) << "alice gets no more while bob is there";
  EXPECT_TRUE(Come("bob"));
}

// Otherwise all would retry at the same moment.
TEST_F(CallRegistryTest, RefusedCallsAreSpread) {
  std::set<double> times;
  for (int i = 0; i < 100; ++i) {
    const double time = registry.RetryAfter();
    EXPECT_GE(time, 1);
    EXPECT_LE(time, 60);
    times.insert(time);
  }
  EXPECT_GT(times.size(), 50U);
}

}  // namespace choreo::call_registry_test
