#include <thread>

#include "client/choreo_client.h"
#include "tests/client/command_fixture.h"
#include "tests/support/expect_error.h"

namespace choreo::health_test {

using HealthTest = CommandTest;

TEST_F(HealthTest, ServesUntilItDrains) {
  const client::Client client({.addresses = {server_.address()}, .retry_s = 0});
  EXPECT_TRUE(client.IsServing());
  const Outcome healthy = Choreo("health" + Server());
  EXPECT_EQ(healthy.code, 0) << healthy.said;
  EXPECT_EQ(healthy.said, "serving\n");

  // A dance that waits for its keys keeps the server from leaving.
  const auto dance = client.StartDance({.frames = 30});
  ASSERT_TRUE(dance->Next());
  std::thread drain([&] { server_.Drain(300); });
  while (client.IsServing()) std::this_thread::yield();
  const Outcome draining = Choreo("health" + Server());
  EXPECT_EQ(draining.code, 1);
  EXPECT_THAT(draining.said,
              testing::HasSubstr(server_.address() + ": does not serve: it drains, or"));
  // Its description is still available.
  const Outcome seen = Choreo("info" + Server());
  EXPECT_EQ(seen.code, 0) << seen.said;
  EXPECT_THAT(seen.said, testing::HasSubstr("1 call in progress"));
  EXPECT_THAT(seen.said, testing::HasSubstr("note: the server drains: it takes no new dances"));
  EXPECT_THAT(Choreo("info --json" + Server()).said, testing::HasSubstr("\"draining\": true"));
  dance->Cancel();
  drain.join();

  ExpectError(ErrorCode::kUnavailable, server_.address(), [&] { client.IsServing(); });
  EXPECT_EQ(Choreo("health" + Server()).code, 1);
}

}  // namespace choreo::health_test
