#pragma once

#include <cstdlib>

namespace choreo {

/// Reads a number from the environment, by which scripts/faults.sh makes a short test long.
inline int Setting(const char* name, int otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr ? otherwise : std::atoi(value);
}

}  // namespace choreo
