#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/client/command_fixture.h"
#include "tests/client/test_server.h"

/// `info` tells which styles are visible, so that nobody looks for others in vain.
namespace choreo::styles_test {

using testing::HasSubstr;
using testing::Not;

/// A fake model with these figures.
class MeasuredSampler final : public FakeSampler {
 public:
  explicit MeasuredSampler(const std::optional<StyleFigures>& figures) {
    model_.style_figures = figures;
  }
};

class StylesTest : public CommandTest {
 protected:
  /// What `info`, and a dance in a style, say of a model with these figures.
  std::string Said(const std::optional<StyleFigures>& figures) {
    const TestServer server(std::make_unique<MeasuredSampler>(figures));
    const std::string there = " --server " + server.address() + " ";
    const Outcome danced =
        Choreo("dance --seconds 1 --style calm -k none" + there + "-o " + At("dance.npz"));
    EXPECT_EQ(danced.code, 0) << danced.said;
    return Choreo("info" + there).said + danced.said;
  }
};

TEST_F(StylesTest, ThoseThatDoNotShowStandApart) {
  const std::string hidden = Said(StyleFigures{.recognised = 7.9, .chance = 6.25, .low = 7.1});
  EXPECT_THAT(hidden, HasSubstr("styles (--style) that do not show: calm, wild"));
  EXPECT_THAT(hidden, HasSubstr("note: --style calm hardly shows"));
  const std::string shown = Said(StyleFigures{.recognised = 51, .chance = 33, .low = 49});
  EXPECT_THAT(shown, HasSubstr("styles (--style) that show: calm, wild"));
  EXPECT_THAT(shown, Not(HasSubstr("note: --style")));
  const std::string unknown = Said({});
  EXPECT_THAT(unknown, HasSubstr("styles (--style): calm, wild"));
  EXPECT_THAT(unknown, Not(HasSubstr("note: --style")));
}

}  // namespace choreo::styles_test
