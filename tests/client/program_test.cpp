#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/client/run_choreo.h"

/// `choreo` before it has a server.
namespace choreo::program_test {

using testing::HasSubstr;
using testing::Not;

TEST(Program, HelpIsACommandToo) {
  for (const auto& [written, meant] :
       {std::pair("help dance", "dance --help"), {"help", "--help"}}) {
    const Outcome outcome = Choreo(written);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.said, Choreo(meant).said);
  }
}

TEST(Program, ServesWithOptionsThatItsHelpNames) {
  EXPECT_THAT(Choreo("serve --help").said, HasSubstr("--listen HOST:PORT"));
}

TEST(Program, ServesAtAnAddress) {
  for (const char* port : {"--port 1", "--port=1"}) {
    const Outcome outcome = Choreo(std::string("serve ") + port);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.said, HasSubstr("--port: is part of --listen HOST:PORT"));
  }
}

TEST(Program, SaysThatItWaitsForAServer) {
  const Outcome outcome = Choreo("info --deadline 2", "CHOREO_SERVER=127.0.0.1:1 ");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, testing::StartsWith(
                                "note: 127.0.0.1:1: no server can be reached: connection "
                                "refused; CHOREO_SERVER names it: start one there (choreo "
                                "serve), or unset CHOREO_SERVER; trying for up to 2 s\nchoreo: "));
}

TEST(Program, NamesTheVariableOfAServerThatIsNotThere) {
  const std::string variable = "CHOREO_SERVER names it: start one there (choreo serve), or unset";
  const Outcome outcome = Choreo("info --deadline 0.3", "CHOREO_SERVER=127.0.0.1:1 ");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.said, HasSubstr("127.0.0.1:1: no server can be reached"));
  EXPECT_THAT(outcome.said, HasSubstr(variable));
  EXPECT_THAT(Choreo("info --deadline 0.3 --server 127.0.0.1:1").said,
              Not(HasSubstr("CHOREO_SERVER")));
}

}  // namespace choreo::program_test
