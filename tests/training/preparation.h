#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "model/training/clips/prepared_clip.h"
#include "model/training/prepare/prepare.h"
#include "tests/support/temporary_folder.h"

namespace choreo {

/// Recordings that a test writes into In(), and their prepared clips.
class Preparation : public testing::Test {
 protected:
  explicit Preparation(const std::string& layout) {
    options_.layout = layout;
    options_.input = folder_ / "in";
    options_.output = folder_ / "out";
    options_.jobs = 1;
    std::filesystem::create_directories(In());
  }
  std::filesystem::path In() const { return options_.input; }
  PreparedClip Clip(const std::string& name) const {
    return ReadPreparedClip(options_.output / (name + ".clip"));
  }
  nlohmann::json Read(const std::string& name) const {
    std::ifstream file(options_.output / name);
    return nlohmann::json::parse(file);
  }
  /// A clip's report, or null.
  nlohmann::json Report(const std::string& name) const {
    for (const auto& report : Read("report.json")) {
      if (report.at("name") == name) return report;
    }
    return nullptr;
  }

  const TemporaryFolder folder_;
  PrepareOptions options_;
};

}  // namespace choreo
