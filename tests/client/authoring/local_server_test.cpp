#include "client/authoring/local_server.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include "client/choreo_client.h"
#include "tests/support/expect_error.h"

namespace choreo::authoring::local_server_test {

TEST(LocalServerTest, ServesAsLongAsItLives) {
  std::string address;
  {
    const LocalServer server{std::filesystem::path(FAKE_CHOREOD)};
    address = server.address();
    const client::Client client({.addresses = {address}});
    EXPECT_EQ(client.GetServerInfo().models.front().name, "fake");
    EXPECT_NE(getpgid(server.process()), getpgid(0)) << "Ctrl-C would reach it";
  }
  const client::Client client({.addresses = {address}, .retry_s = 0});
  ExpectError(ErrorCode::kUnavailable, address, [&] { client.GetServerInfo(); });
}

// Waiting for a lost server is useless.
TEST(LocalServerTest, NoticesThatItIsGone) {
  LocalServer server{std::filesystem::path(FAKE_CHOREOD)};
  const client::Client client({.addresses = {server.address()},
                               .retry_s = 1e6,
                               .before_retry = [&] { server.RequireRunning(); }});
  client.GetServerInfo();
  server.RequireRunning();
  kill(server.process(), SIGKILL);
  ExpectError(ErrorCode::kUnavailable, "server of this command has ended (Killed)",
              [&] { client.GetServerInfo(); });
  EXPECT_EQ(server.process(), -1);
}

TEST(LocalServerTest, ReportsAMissingProgram) {
  ExpectError(ErrorCode::kNotFound, "/absent/choreod",
              [] { LocalServer server{std::filesystem::path("/absent/choreod")}; });
  // It ends without a word.
  ExpectError(ErrorCode::kUnavailable, "did not start",
              [] { LocalServer server{std::filesystem::path("/bin/true")}; });
}

}  // namespace choreo::authoring::local_server_test
