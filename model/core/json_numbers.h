#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "model/core/error.h"

namespace choreo {

/// Refuses numbers beyond those of an int: read as one they would be another, or undefined. For
/// what holds no larger ones and at most so many levels, such as skeletons and the configurations
/// of networks. Throws Error(kInvalidArgument) whose field is `name`, naming number and limit.
inline void CheckJsonNumbers(const nlohmann::json& json, const std::string& name, int levels = 16) {
  constexpr double kLimit = std::numeric_limits<int>::max();
  if (json.is_number()) {
    const auto number = json.get<double>();
    if (number >= -kLimit && number <= kLimit) return;
    throw InvalidArgument(name, "the number " + json.dump() + " is beyond 2147483647");
  }
  if (!json.is_structured()) return;
  if (levels == 0) throw InvalidArgument(name, "is JSON of more than 16 levels");
  for (const auto& value : json) CheckJsonNumbers(value, name, levels - 1);
}

}  // namespace choreo
