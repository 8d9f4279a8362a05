#pragma once

#include <cstdlib>

namespace choreo {

/// A number from the environment that makes a short test long (scripts/faults.sh).
inline int Setting(const char* name, int otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr ? otherwise : std::atoi(value);
}

}  // namespace choreo
