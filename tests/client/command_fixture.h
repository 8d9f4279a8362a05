#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/client/run_choreo.h"
#include "tests/client/test_server.h"
#include "tests/support/temporary_folder.h"

/// `choreo` as people run it.
namespace choreo {

/// A folder of its own and a server in this process.
class CommandTest : public testing::Test {
 protected:
  std::string At(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  std::string Server() const { return " --server " + server_.address() + " "; }

  TemporaryFolder folder_;
  TestServer server_;
};

}  // namespace choreo
