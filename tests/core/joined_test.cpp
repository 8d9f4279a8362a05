#include "model/core/joined.h"

#include <gtest/gtest.h>

#include <vector>

namespace choreo::joined_test {

TEST(Joined, SeparatesTheTextsOfElements) {
  EXPECT_EQ(Joined(std::vector<std::string>{}), "");
  EXPECT_EQ(Joined(std::vector<std::string>{"calm"}), "calm");
  EXPECT_EQ(Joined(std::vector<std::string_view>{"calm", "wild"}), "calm, wild");
  const auto text = [](int number) { return std::to_string(number); };
  EXPECT_EQ(Joined(std::vector<int>{1, 2, 3}, text, " or "), "1 or 2 or 3");
}

}  // namespace choreo::joined_test
