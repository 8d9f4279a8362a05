#include <gtest/gtest.h>

#include <thread>

#include "client/replicas.h"

namespace choreo::client::patience_test {

const grpc::Status kGone(grpc::StatusCode::UNAVAILABLE, "connection refused");

TEST(PatienceTest, IsATimeNotACount) {
  Patience patience({.retry_s = 1e6, .first_backoff_s = 1e-6});
  for (int i = 0; i < 1000; ++i) {
    const auto wait = patience.Next(kGone, false);
    ASSERT_TRUE(wait) << i;
    EXPECT_LE(wait->count(), 2);
  }
}

TEST(PatienceTest, EndsAfterItsTimeWithoutProgress) {
  Patience patience({.retry_s = 1e-3});
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(patience.Next(kGone, false)) << "the time runs from the first failure";
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(patience.Next(kGone, false));
  patience.Reset();
  EXPECT_TRUE(patience.Next(kGone, false)) << "progress makes patient again";
}

TEST(PatienceTest, NoTimeIsNoRetry) { EXPECT_FALSE(Patience({.retry_s = 0}).Next(kGone, true)); }

TEST(PatienceTest, DoesNotRetryPermanentErrors) {
  EXPECT_FALSE(Patience({.retry_s = 1e6}).Next({grpc::StatusCode::INVALID_ARGUMENT, "no"}, true));
}

const grpc::Status kBroken(grpc::StatusCode::INTERNAL, "the device is gone");

TEST(PatienceTest, BrokenReplicaIsRetriedElsewhereUntilAllAreBroken) {
  EXPECT_FALSE(Patience({.retry_s = 1e6}).Next(kBroken, false));
  Patience patience({.addresses = {"a:1", "b:1", "c:1"}, .retry_s = 1e6});
  EXPECT_TRUE(patience.Next(kBroken, true));
  EXPECT_TRUE(patience.Next(kBroken, true));
  EXPECT_FALSE(patience.Next(kBroken, true));
}

TEST(PatienceTest, RetriesAReplicaThatWasAway) {
  Patience patience({.addresses = {"a:1", "b:1"}, .retry_s = 1e6, .first_backoff_s = 1e-6});
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(patience.Next(kBroken, true));
    ASSERT_TRUE(patience.Next(kGone, true));
  }
  EXPECT_EQ(patience.Verdict().error_message(), "the device is gone");
}

}  // namespace choreo::client::patience_test
