#include "server/accept_guard.h"

#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <sstream>
#include <string>

#include "server/connections/frame_guard.h"
#include "server/connections/held_off.h"
#include "server/connections/reset_guard.h"
#include "server/telemetry/tally.h"

namespace choreo::accept_guard_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

class AcceptGuardTest : public testing::Test {
 protected:
  // How many of these simultaneous connections are accepted.
  int Takes(int count, const std::string& address = "ipv4:192.0.2.1") {
    int taken = 0;
    for (int i = 0; i < count; ++i) taken += guard_.TakesFrom(address, now_) ? 1 : 0;
    return taken;
  }

  AcceptGuard::Clock::time_point now_ = AcceptGuard::Clock::now();
  const ResetGuard resets_{1};
  Tally tally_;
  AcceptGuard guard_{resets_, tally_};
};

TEST_F(AcceptGuardTest, ManyMayComeAtOnceAndThenByRate) {
  EXPECT_EQ(Takes(10 * AcceptGuard::kAtOnce), AcceptGuard::kAtOnce);
  for (int second = 0; second < 3; ++second) {
    now_ += seconds(1);
    EXPECT_EQ(Takes(10 * AcceptGuard::kPerSecond), AcceptGuard::kPerSecond);
  }
}

TEST_F(AcceptGuardTest, AddressesAreBoundedEachByItself) {
  EXPECT_EQ(Takes(10 * AcceptGuard::kAtOnce), AcceptGuard::kAtOnce);
  EXPECT_EQ(Takes(10, "ipv4:192.0.2.2"), 10);
  EXPECT_EQ(Takes(10), 0);
}

TEST_F(AcceptGuardTest, WhoWaitsMayComeAtOnceAgain) {
  Takes(AcceptGuard::kAtOnce);
  now_ += seconds(AcceptGuard::kAtOnce / AcceptGuard::kPerSecond);
  EXPECT_EQ(Takes(10 * AcceptGuard::kAtOnce), AcceptGuard::kAtOnce);
}

TEST_F(AcceptGuardTest, HonestRatesAreNeverRefused) {
  for (int i = 0; i < 10 * AcceptGuard::kAtOnce; ++i) {
    EXPECT_EQ(Takes(1), 1);
    now_ += milliseconds(1000 / AcceptGuard::kPerSecond + 1);
  }
}

TEST_F(AcceptGuardTest, EachRefusalIsToldOfOnceAndCounted) {
  std::ostringstream log;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "guard", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)));
  const auto refuse = [&](int count) {
    for (int i = 0; i < count; ++i) guard_.Refuse("ipv4:192.0.2.1", ConnectionRefusal::kRate, now_);
  };
  const auto lines = [&] {
    const std::string text = log.str();
    return std::ranges::count(text, '\n');
  };
  refuse(170);
  guard_.Report(now_);
  EXPECT_EQ(lines(), 1);
  EXPECT_THAT(log.str(), HasSubstr("192.0.2.1 connects too often; its new connection is closed"));
  now_ += seconds(60);
  guard_.Report(now_);
  guard_.Report(now_ + seconds(60));
  EXPECT_EQ(lines(), 2);
  EXPECT_THAT(log.str(), HasSubstr("169 new connections were closed"));
  refuse(3);
  EXPECT_EQ(lines(), 2);
  guard_.ReportRest();
  EXPECT_THAT(log.str(), HasSubstr("3 new connections were closed"));
  spdlog::set_default_logger(before);
}

// Like other floods: one more call would cost memory, and the next connection would bring it.
TEST(ResetGuardTest, AFloodOfCallsIsCountedAndHeldOff) {
  ResetGuard guard(2);
  const std::string peer = "ipv4:192.0.2.1:7", other = "ipv4:192.0.2.2:7";
  const uint64_t before = EmptyFrameFloods();
  for (int i = 0; i < 2; ++i) guard.Enter(peer);
  EXPECT_FALSE(guard.held_off()->Has("ipv4:192.0.2.1"));
  for (int i = 0; i < 10; ++i) guard.Enter(peer);
  guard.Enter(other);
  EXPECT_EQ(EmptyFrameFloods(), before + 1) << "one connection";
  for (int i = 0; i < 12; ++i) guard.Leave(peer);
  EXPECT_TRUE(guard.held_off()->Has("ipv4:192.0.2.1")) << "when its calls are done, too";
  EXPECT_FALSE(guard.held_off()->Has("ipv4:192.0.2.2"));
}

TEST(HeldOffTest, ForgetsAfterAWhile) {
  HeldOff held;
  const auto now = HeldOff::Clock::now();
  held.Add("ipv4:192.0.2.1", now);
  EXPECT_TRUE(held.Has("ipv4:192.0.2.1", now + HeldOff::kTime - milliseconds(1)));
  EXPECT_FALSE(held.Has("ipv4:192.0.2.2", now));
  EXPECT_FALSE(held.Has("ipv4:192.0.2.1", now + HeldOff::kTime));
}

}  // namespace choreo::accept_guard_test
