#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/client/test_server.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

/// `choreo` as people run it.
namespace choreo {

/// Runs `choreo` as a shell would, which does `first` before.
inline Outcome Choreo(const std::string& arguments, const std::string& first = "") {
  return Shell(first + "'" CHOREO_PROGRAM "' " + arguments);
}

inline nlohmann::json ReadJson(const std::filesystem::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

/// A folder of its own and a server in this process.
class CommandTest : public testing::Test {
 protected:
  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  std::string Server() const { return " --server " + server_.address() + " "; }

  TemporaryFolder folder_;
  TestServer server_;
};

}  // namespace choreo
