#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/shell.h"

namespace choreo {

/// NumPy's own opinion, where a python3 has it.
inline bool HaveNumpy() {
  return std::system("/usr/bin/python3 -c 'import numpy' >/dev/null 2>&1") == 0;
}

/// Runs a script (numpy is `np`, `path` the file) and returns what it prints.
inline std::string RunNumpy(const std::filesystem::path& path, const std::string& script) {
  const std::filesystem::path file = path.string() + ".py";
  std::ofstream(file) << "import numpy as np\npath = '" << path.string() << "'\n" << script;
  return Shell("/usr/bin/python3 '" + file.string() + "'").said;
}

}  // namespace choreo
