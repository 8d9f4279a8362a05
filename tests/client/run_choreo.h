#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/shell.h"

namespace choreo {

/// Runs `choreo` as a shell would, which does `first` before.
inline Outcome Choreo(const std::string& arguments, const std::string& first = "") {
  return Shell(first + "'" CHOREO_PROGRAM "' " + arguments);
}

inline nlohmann::json ReadJson(const std::filesystem::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

}  // namespace choreo
