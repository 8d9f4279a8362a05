#include <gtest/gtest.h>

#include <chrono>

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
  Patience patience({.retry_s = 10});
  const auto failed_after = [&](int seconds) {
    return patience.Next(kGone, false,
                         std::chrono::steady_clock::time_point(std::chrono::seconds(seconds)));
  };
  EXPECT_TRUE(failed_after(50)) << "the time runs from the first failure";
  EXPECT_TRUE(failed_after(59));
  EXPECT_FALSE(failed_after(60));
  patience.Reset();
  EXPECT_TRUE(failed_after(61)) << "progress makes patient again";
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
