#pragma once

#include <concepts>
#include <string>

namespace choreo {

/// A count of things, for messages: "1 bar", "2 bars".
std::string Counted(std::integral auto count, const std::string& what) {
  return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

}  // namespace choreo
