#include "model/core/files/json_limits.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/expect_error.h"

namespace choreo::json_limits_test {

TEST(JsonNumbers, AcceptsIntsAnywhere) {
  CheckJsonNumbers(nlohmann::json::parse(R"({"a": [1, -2147483647, 0.5, {"b": 2147483647}]})"), "");
  CheckJsonNumbers(nlohmann::json::parse(R"(["9e9", null, true])"), "");
}

TEST(JsonNumbers, RefusesLargerOnesByName) {
  for (const char* number : {"9e9", "-9e9", "2147483648", "18446744073709551615", "1e308"}) {
    const auto json = nlohmann::json::parse("{\"a\": [{\"b\": " + std::string(number) + "}]}");
    ExpectError(ErrorCode::kInvalidArgument, "skeleton: the number ",
                [&] { CheckJsonNumbers(json, "skeleton"); });
  }
}

TEST(JsonNumbers, RefusesDeepNesting) {
  const auto json = nlohmann::json::parse(std::string(100'000, '[') + std::string(100'000, ']'));
  ExpectError(ErrorCode::kInvalidArgument, "more than 16 levels",
              [&] { CheckJsonNumbers(json, "skeleton"); });
}

TEST(JsonDepth, RefusesBytesThatAreNoText) {
  const auto refused = [](const std::string& bytes, const std::string& why) {
    ExpectError(ErrorCode::kInvalidArgument, "a.png: is not JSON, nor any text: " + why,
                [&] { CheckJsonDepth(bytes, "a.png"); });
  };
  refused("\x89PNG\r\n\x1a\n", "byte 6 is 26");
  refused(std::string(1, '\0') + std::string(100, '{'), "byte 0 is 0");
  CheckJsonDepth("{\r\n\t\"é\": 1}", "");
  CheckJsonDepth("{}" + std::string(2, '\0'), "");  // as some programs end a GLB's JSON
}

}  // namespace choreo::json_limits_test
