#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace choreo {

struct Outcome {
  int code = -1;     ///< exit status; -1 if killed by a signal
  std::string said;  ///< stdout and stderr
};

/// Runs a shell command line.
inline Outcome Shell(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  Outcome outcome;
  std::array<char, 4096> buffer;
  while (const size_t count = fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.said.append(buffer.data(), count);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

}  // namespace choreo
