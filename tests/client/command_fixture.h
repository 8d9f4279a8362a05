#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/client/test_server.h"
#include "tests/support/temporary_folder.h"

/// `choreo` as people run it.
namespace choreo {

struct Outcome {
  int code = -1;
  std::string said;  ///< stdout and stderr
};

/// Runs `choreo` as a shell would, which does `first` before.
inline Outcome Choreo(const std::string& arguments, const std::string& first = "") {
  const std::string command = first + "'" CHOREO_PROGRAM "' " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer;
  while (const size_t count = fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.said.append(buffer.data(), count);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
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
