#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

/// Parts of error messages: paths of fields and numbers. See also rounded.h.
namespace choreo {

/// The name of element `index` of a list: "frames[3]".
inline std::string At(const std::string& field, int64_t index) {
  return field + '[' + std::to_string(index) + ']';
}

/// Formats a number for messages: six digits, without trailing zeros.
inline std::string Show(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace choreo
