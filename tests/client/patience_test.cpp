#include <gtest/gtest.h>

#include <chrono>

#include "client/cli/options/connection.h"
#include "client/replicas.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace choreo::client::patience_test {

const grpc::Status kGone(grpc::StatusCode::UNAVAILABLE, "connection refused");

TEST(PatienceTest, IsATimeNotACount) {
  Patience patience({.retry_s = 1e6, .first_backoff_s = 1e-6});
  for (int i = 0; i < 1000; ++i) {
    const auto wait = patience.Next(kGone, "a:1", false);
    ASSERT_TRUE(wait) << i;
    EXPECT_LE(wait->count(), 2);
  }
}

TEST(PatienceTest, EndsAfterItsTimeWithoutProgress) {
  Patience patience({.retry_s = 10});
  const auto failed_after = [&](int seconds) {
    return patience.Next(kGone, "a:1", false,
                         std::chrono::steady_clock::time_point(std::chrono::seconds(seconds)));
  };
  EXPECT_TRUE(failed_after(50)) << "the time runs from the first failure";
  EXPECT_TRUE(failed_after(59));
  EXPECT_FALSE(failed_after(60));
  patience.Reset();
  EXPECT_TRUE(failed_after(61)) << "progress makes patient again";
}

grpc::Status FullFor(int seconds) {
  google::rpc::RetryInfo retry;
  retry.mutable_retry_delay()->set_seconds(seconds);
  google::rpc::Status details;
  details.add_details()->PackFrom(retry);
  return {grpc::StatusCode::RESOURCE_EXHAUSTED, "the server is full", details.SerializeAsString()};
}

TEST(PatienceTest, NoWaitIsLongerThanWhatIsLeft) {
  using Time = std::chrono::steady_clock::time_point;
  Patience patience({.retry_s = 10, .first_backoff_s = 2});
  EXPECT_EQ(patience.Next(FullFor(9), "a:1", false, Time()), std::chrono::seconds(9));
  EXPECT_FALSE(patience.Next(FullFor(2), "a:1", false, Time(std::chrono::seconds(9))))
      << "one second is left";
  EXPECT_TRUE(patience.Next(FullFor(60), "a:1", true, Time(std::chrono::seconds(9))))
      << "another one may have room";
  const auto last = patience.Next(kGone, "a:1", false, Time(std::chrono::milliseconds(9900)));
  ASSERT_TRUE(last);
  EXPECT_LE(last->count(), 0.1001);
}

// A full server may ask for more than the ten seconds of others.
TEST(PatienceTest, ALongDeadlineIsTimeForRetries) {
  cli::ServerOptions options;
  EXPECT_EQ(options.ForClient().retry_s, Options().retry_s);
  options.deadline_s = 60;
  EXPECT_EQ(Patience(options.ForClient()).Next(FullFor(40), "a:1", false),
            std::chrono::seconds(40));
}

TEST(PatienceTest, NoTimeIsNoRetry) {
  EXPECT_FALSE(Patience({.retry_s = 0}).Next(kGone, "a:1", true));
}

TEST(PatienceTest, DoesNotRetryPermanentErrors) {
  EXPECT_FALSE(
      Patience({.retry_s = 1e6}).Next({grpc::StatusCode::INVALID_ARGUMENT, "no"}, "a:1", true));
}

const grpc::Status kBroken(grpc::StatusCode::INTERNAL, "the device is gone");

TEST(PatienceTest, BrokenReplicaIsRetriedElsewhereUntilAllAreBroken) {
  EXPECT_FALSE(Patience({.retry_s = 1e6}).Next(kBroken, "a:1", false));
  Patience patience({.addresses = {"a:1", "b:1", "c:1"}, .retry_s = 1e6});
  EXPECT_TRUE(patience.Next(kBroken, "a:1", true));
  EXPECT_TRUE(patience.Next(kBroken, "a:1", true));
  EXPECT_FALSE(patience.Next(kBroken, "a:1", true));
}

grpc::Status Draining() {
  google::rpc::ErrorInfo why;
  why.set_reason("DRAINING");
  google::rpc::Status details;
  details.add_details()->PackFrom(why);
  return {grpc::StatusCode::UNAVAILABLE, "the server is draining", details.SerializeAsString()};
}

TEST(PatienceTest, LeavesAServerThatDrainsAtOnce) {
  Patience patience({.addresses = {"a:1", "b:1", "c:1"}, .retry_s = 1e6, .first_backoff_s = 2});
  const std::chrono::seconds none(0);
  EXPECT_EQ(patience.Next(Draining(), "a:1", true), none);
  EXPECT_EQ(patience.Next(Draining(), "b:1", true), none);
  EXPECT_GT(patience.Next(Draining(), "c:1", true), none) << "all of them drain";
  patience.Reset();
  EXPECT_EQ(patience.Next(Draining(), "a:1", true), none);
  EXPECT_GT(Patience({.retry_s = 1e6}).Next(Draining(), "a:1", false), none) << "there is no other";
  // What gRPC says where the health of a server is watched.
  const grpc::Status unhealthy(
      grpc::StatusCode::UNAVAILABLE,
      "connections to all backends failing; last error: UNAVAILABLE: backend unhealthy");
  patience.Reset();
  EXPECT_EQ(patience.Next(unhealthy, "a:1", true), none);
  EXPECT_STREQ(ToError(unhealthy, "a:1", {}).what(),
               "a:1: the server takes no calls: it drains, or an engine of it fails");
}

TEST(PatienceTest, NamesAllAddressesThatWereTried) {
  const grpc::Status away(
      grpc::StatusCode::UNAVAILABLE,
      "failed to connect to all addresses; last error: UNKNOWN: ipv4:127.0.0.1:1: Failed to "
      "connect to remote host: Connection refused");
  Patience patience({.addresses = {"a:1", "b:1"}, .retry_s = 1e6});
  for (int i = 0; i < 2; ++i) {
    for (const char* address : {"a:1", "b:1"}) ASSERT_TRUE(patience.Next(away, address, true));
  }
  EXPECT_STREQ(ToError(patience.Verdict(), patience.VerdictOf(), {}).what(),
               "a:1, b:1: no server can be reached: connection refused");
  ASSERT_TRUE(patience.Next(kBroken, "b:1", true));
  ASSERT_TRUE(patience.Next(away, "a:1", true));
  EXPECT_STREQ(ToError(patience.Verdict(), patience.VerdictOf(), {}).what(), "the device is gone");
}

TEST(PatienceTest, SaysThatALoneServerStopped) {
  const grpc::Status away(
      grpc::StatusCode::UNAVAILABLE,
      "failed to connect to all addresses; last error: UNKNOWN: ipv4:127.0.0.1:1: Failed to "
      "connect to remote host: Connection refused");
  Patience patience({.addresses = {"a:1"}, .retry_s = 1e6});
  ASSERT_TRUE(patience.Next(Draining(), "a:1", false));
  ASSERT_TRUE(patience.Next(away, "a:1", false));
  EXPECT_STREQ(ToError(patience.Verdict(), patience.VerdictOf(), {}).what(),
               "a:1: the server is draining");
  patience.Reset();
  ASSERT_TRUE(patience.Next(away, "a:1", false));
  EXPECT_STREQ(ToError(patience.Verdict(), patience.VerdictOf(), {}).what(),
               "a:1: no server can be reached: connection refused");
}

TEST(PatienceTest, RetriesAReplicaThatWasAway) {
  Patience patience({.addresses = {"a:1", "b:1"}, .retry_s = 1e6, .first_backoff_s = 1e-6});
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(patience.Next(kBroken, "a:1", true));
    ASSERT_TRUE(patience.Next(kGone, "a:1", true));
  }
  EXPECT_EQ(patience.Verdict().error_message(), "the device is gone");
}

}  // namespace choreo::client::patience_test
