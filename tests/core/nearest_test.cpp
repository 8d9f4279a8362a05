#include "model/core/text/nearest.h"

#include <gtest/gtest.h>

namespace choreo::nearest_test {

TEST(Nearest, SuggestsTheNearestWordOrListsAll) {
  const std::vector<std::string> poses = {"kick", "dab", "bow"};
  EXPECT_EQ(DidYouMean("kik", poses), "did you mean kick?");
  EXPECT_EQ(DidYouMean("Kick", poses), "did you mean kick?");
  EXPECT_EQ(DidYouMean("bwo", poses), "did you mean bow?") << "letters exchanged";
  EXPECT_EQ(DidYouMean("owb", poses), "it has kick, dab, bow") << "two letters wrong";
  EXPECT_EQ(DidYouMean("swan", poses), "it has kick, dab, bow");
  EXPECT_EQ(DidYouMean("swan", poses, std::identity(), 2), "it has kick, dab, ...");
  EXPECT_EQ(DidYouMean("bowl", poses, std::identity(), 1), "did you mean bow?") << "beyond those";
  EXPECT_EQ(DidYouMean("swan", std::vector<std::string>{}), "it has none");
}

}  // namespace choreo::nearest_test
