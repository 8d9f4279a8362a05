#include "client/cli/local_server.h"

#include <gtest/gtest.h>

#include "client/choreo_client.h"
#include "tests/support/expect_error.h"

namespace choreo::cli {
namespace {

TEST(LocalServerTest, ServesAsLongAsItLives) {
  std::string address;
  {
    const LocalServer server{std::filesystem::path(FAKE_CHOREOD)};
    address = server.address();
    const client::Client client({.addresses = {address}});
    EXPECT_EQ(client.GetServerInfo().models.front().name, "fake");
  }
  const client::Client client({.addresses = {address}, .retry_s = 0});
  ExpectError(ErrorCode::kUnavailable, address, [&] { client.GetServerInfo(); });
}

TEST(LocalServerTest, SaysWhenThereIsNothingToStart) {
  ExpectError(ErrorCode::kNotFound, "/absent/choreod",
              [] { LocalServer server{std::filesystem::path("/absent/choreod")}; });
  // It ends without a word.
  ExpectError(ErrorCode::kUnavailable, "did not start",
              [] { LocalServer server{std::filesystem::path("/bin/true")}; });
}

}  // namespace
}  // namespace choreo::cli
