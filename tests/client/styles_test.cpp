#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/client/command_fixture.h"
#include "tests/client/test_server.h"

/// Users learn which styles show before they look for them in vain.
namespace choreo::styles_test {

using testing::HasSubstr;
using testing::Not;

class StylesTest : public CommandTest {
 protected:
  /// What `info`, and a dance in a style, say of a model with this fingerprint.
  std::string Said(const std::string& fingerprint) {
    const TestServer server(fingerprint);
    const std::string there = " --server " + server.address() + " ";
    const Outcome danced =
        Choreo("dance --seconds 1 --style calm -k none" + there + "-o " + At("dance.npz"));
    EXPECT_EQ(danced.code, 0) << danced.said;
    return Choreo("info" + there).said + danced.said;
  }
};

TEST_F(StylesTest, ThoseThatDoNotShowStandApart) {
  const std::string hidden = Said("default/26bfadad19dc69d0590692f89aafbedb/choreo 1.0.0");
  EXPECT_THAT(hidden, HasSubstr("styles (--style) that do not show: calm, wild"));
  EXPECT_THAT(hidden, HasSubstr("note: --style calm hardly shows"));
  const std::string shown = Said("free/7286cdc80932bef860a65c06cf4d9667/choreo 1.0.0");
  EXPECT_THAT(shown, HasSubstr("styles (--style) that show: calm, wild"));
  EXPECT_THAT(shown, Not(HasSubstr("note: --style")));
  const std::string unknown = Said("fake-1");
  EXPECT_THAT(unknown, HasSubstr("styles (--style): calm, wild"));
  EXPECT_THAT(unknown, Not(HasSubstr("note: --style")));
}

}  // namespace choreo::styles_test
