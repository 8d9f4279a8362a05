#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "model/core/error.h"

/// Limits on untrusted JSON. All functions throw Error(kInvalidArgument) whose field is `name`,
/// naming the limit or the fault.
namespace choreo {

/// Refuses bytes that are no text, such as a picture's, in which brackets mean no levels. Accepts
/// NUL at the end, with which some programs fill up a GLB's JSON.
inline void CheckIsText(std::string_view json, const std::string& name) {
  const size_t end = json.find_last_not_of('\0') + 1;
  for (size_t i = 0; i < end; ++i) {
    const auto c = static_cast<unsigned char>(json[i]);
    if (c >= ' ' || c == '\t' || c == '\n' || c == '\r') continue;
    throw InvalidArgument(
        name, "is not JSON, nor any text: byte " + std::to_string(i) + " is " + std::to_string(c));
  }
}

/// Refuses what is no text, and JSON that is nested deeper than our files or any glTF. Code that
/// parses, copies or prints JSON recurses once per level, so deep nesting would overflow the stack.
/// The parser finds other faults.
inline void CheckJsonDepth(std::string_view json, const std::string& name) {
  constexpr int kLimit = 64;
  CheckIsText(json, name);
  int depth = 0;
  bool in_text = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"') {
      in_text = !in_text;
    } else if (in_text) {
      if (c == '\\') ++i;
    } else if (c == '[' || c == '{') {
      if (++depth > kLimit) {
        throw InvalidArgument(name, "is JSON of more than " + std::to_string(kLimit) +
                                        " levels, from character " + std::to_string(i));
      }
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

inline constexpr int kMaxJsonLevels = 16;  ///< for skeletons and configurations

/// Refuses numbers that don't fit into an int, whose conversion would be undefined. For JSON
/// without larger numbers or deeper nesting: skeletons and network configurations.
inline void CheckJsonNumbers(const nlohmann::json& json, const std::string& name,
                             int levels = kMaxJsonLevels) {
  constexpr double kLimit = std::numeric_limits<int>::max();
  if (json.is_number()) {
    const auto number = json.get<double>();
    if (number >= -kLimit && number <= kLimit) return;
    throw InvalidArgument(name, "the number " + json.dump() + " is beyond 2147483647");
  }
  if (!json.is_structured()) return;
  if (levels == 0)
    throw InvalidArgument(name,
                          "is JSON of more than " + std::to_string(kMaxJsonLevels) + " levels");
  for (const auto& value : json) CheckJsonNumbers(value, name, levels - 1);
}

}  // namespace choreo
