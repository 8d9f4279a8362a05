#include "network/address.h"
#include "network/protocol.h"

#include <gtest/gtest.h>

#include <utility>

namespace choreo::address_test {

using Parts = std::pair<std::string, std::string>;

TEST(Address, IsSplitAtItsLastColon) {
  const auto parts = [](const std::string& address) {
    const auto [host, port] = SplitAddress(address);
    return Parts(host, port);
  };
  EXPECT_EQ(parts("localhost:80"), Parts("localhost", "80"));
  EXPECT_EQ(parts("[::1]:80"), Parts("[::1]", "80"));
  EXPECT_EQ(parts("nowhere"), Parts("nowhere", ""));
  EXPECT_EQ(parts(":80"), Parts("", "80"));
  EXPECT_EQ(WithoutBrackets("[::1]"), "::1");
  EXPECT_EQ(WithoutBrackets("localhost"), "localhost");
  EXPECT_EQ(WithoutBrackets("["), "[");
}

TEST(Address, APortHasDigitsAlone) {
  EXPECT_EQ(ParsePort("0"), 0);
  EXPECT_EQ(ParsePort("65535"), kMaxPort);
  for (const char* bad : {"", "65536", "-1", "+1", "80x", " 80", "99999999999999999999"})
    EXPECT_EQ(ParsePort(bad), std::nullopt) << bad;
}

}  // namespace choreo::address_test
