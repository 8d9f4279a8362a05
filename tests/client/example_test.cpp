#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/client/test_server.h"
#include "tests/support/shell.h"

/// The example of the README and the program that it is taken from.
namespace choreo::example_test {

std::string ReadFile(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Removes what precedes the first letter of each line.
std::string WithoutIndentation(const std::string& text) {
  std::istringstream lines(text);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    const size_t start = line.find_first_not_of(' ');
    out += (start == std::string::npos ? "" : line.substr(start)) + "\n";
  }
  return out;
}

TEST(ExampleTest, TheReadmesExampleIsPartOfTheProgram) {
  const std::string readme = ReadFile(SOURCE_FOLDER "/README.md");
  const std::string fence = "```cpp\n";
  const size_t begin = readme.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const size_t end = readme.find("```", begin + fence.size());
  const std::string shown = readme.substr(begin + fence.size(), end - begin - fence.size());
  EXPECT_THAT(WithoutIndentation(ReadFile(SOURCE_FOLDER "/examples/client/first_dance.cpp")),
              testing::HasSubstr(WithoutIndentation(shown)));
}

TEST(ExampleTest, ItDances) {
  TestServer server;
  const Outcome outcome = Shell("'" FIRST_DANCE "' " + server.address());
  EXPECT_EQ(outcome.code, 0) << outcome.said;
  EXPECT_THAT(outcome.said, testing::HasSubstr("76 frames"));
}

}  // namespace choreo::example_test
