#include "server/calls/call_session.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/advanced_clock.h"
#include "tests/support/fake_sampler.h"
#include "tests/support/temporary_folder.h"

namespace choreo::call_session_test {

using Response = v1::StreamDanceResponse;

/// Completes a write only when the test says so.
struct SlowWire : Outbox<Response>::Wire {
  void Write(const Response* /*message*/) override {}
  void Finish(const grpc::Status& /*status*/) override {}
};

struct PausedOrNot {
  bool IsSampling() const { return false; }
  void SetPaused(bool now) { paused = now; }
  void Cancel() {}
  bool paused = false;
};

class Session final : public CallSession<Response, PausedOrNot> {
 public:
  using CallSession::Adopt;
  using CallSession::CallSession;
};

class CallSessionTest : public testing::Test {
 protected:
  static constexpr size_t kOutboxBytes = 100;

  static std::vector<std::unique_ptr<SampleQueue>> OneModel() {
    std::vector<std::unique_ptr<SampleQueue>> models;
    models.push_back(std::make_unique<SampleQueue>(FakeSamplers(), SampleQueue::Options{}));
    return models;
  }
  void SendMuch() {
    Response response;
    response.mutable_header()->set_model(std::string(2 * kOutboxBytes, 'm'));
    session.outbox().Send(response);
  }

  Serving serving{OneModel(), CallLimits{}, FrameShares{}, "", kOutboxBytes, 0, 1, 1};
  SlowWire wire;
  Session session{serving, &wire, "StreamDance", Caller{}};
  std::shared_ptr<PausedOrNot> dance = std::make_shared<PausedOrNot>();
};

// A file that is being rewritten lacks some tokens for a moment, or cannot be read.
TEST_F(CallSessionTest, ARevokedTokenEndsTheCallAfterTwoSeconds) {
  const std::string alice =
      "ca978112ca1bbdcafac231b39a23dc4da786eff8147c4e72b9807785afee48bb alice\n";
  const std::string bob = "3e23e8160039594a33894f6564e1b1348bbd7a0088d42c4acb73eeaed59c009d bob\n";
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "tokens";
  const auto write = [&](const std::string& lines) { std::ofstream(file) << lines; };
  write(alice + bob);
  AdvancedClock clock;
  Serving reloading{OneModel(), CallLimits{}, FrameShares{}, file, kOutboxBytes, 0, 1, 1, clock};
  Session hers{reloading, &wire, "StreamDance", Caller{}};
  ASSERT_TRUE(hers.Authenticate("Bearer a"));
  const auto dances_after = [&](std::chrono::seconds time) {
    clock.Advance(time);
    reloading.tokens.Refresh();
    hers.EndIfRevoked();
    return hers.outbox().open();
  };
  std::filesystem::remove(file);
  EXPECT_TRUE(dances_after(std::chrono::seconds(0)));
  EXPECT_TRUE(dances_after(std::chrono::minutes(1))) << "nobody knows what it says";
  write(bob);
  EXPECT_TRUE(dances_after(std::chrono::seconds(0)));
  EXPECT_TRUE(dances_after(std::chrono::seconds(1)));
  write(alice + bob);
  EXPECT_TRUE(dances_after(std::chrono::seconds(5))) << "it came back";
  write(bob);
  EXPECT_TRUE(dances_after(std::chrono::seconds(0)));
  EXPECT_FALSE(dances_after(std::chrono::seconds(2)));
}

TEST_F(CallSessionTest, UnreadMessagesPauseTheLaterDance) {
  SendMuch();
  session.Adopt(dance);
  EXPECT_TRUE(dance->paused);
  session.outbox().OnWriteDone(true);
  EXPECT_FALSE(dance->paused);
}

TEST_F(CallSessionTest, ReadMessagesPauseNothing) {
  SendMuch();
  session.outbox().OnWriteDone(true);
  session.Adopt(dance);
  EXPECT_FALSE(dance->paused);
  SendMuch();
  EXPECT_TRUE(dance->paused);
}

TEST_F(CallSessionTest, AnOkThatNeverWentOutIsCancelled) {
  session.outbox().End(grpc::Status::OK, Ending::kAfterQueued);
  session.Release(/*lost=*/true);
  const auto calls = serving.tally.calls();
  ASSERT_EQ(calls.size(), 1U);
  EXPECT_EQ(calls.begin()->first.second, grpc::StatusCode::CANCELLED);
}

TEST_F(CallSessionTest, AnErrorKeepsItsName) {
  session.End(InvalidArgument("config", "missing"));
  session.Release(/*lost=*/true);
  const auto calls = serving.tally.calls();
  ASSERT_EQ(calls.size(), 1U);
  EXPECT_EQ(calls.begin()->first.second, grpc::StatusCode::INVALID_ARGUMENT);
}

}  // namespace choreo::call_session_test
