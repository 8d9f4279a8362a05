#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/cli/counts.h"

namespace choreo::cli {

inline constexpr int kMostDancers = 64;

/// One of several who dance together. What she does not say, she does as all.
struct Dancer {
  std::string id;
  Eigen::Vector2d place = {0, 0};   ///< x and z of the stage where her own dance has its origin
  double facing = 0;                ///< degrees that her dance is turned: 90 is along x
  bool mirrored = false;            ///< left is right
  std::optional<Delay> after = {};  ///< she does all so much later, and stands still before
  std::optional<uint64_t> seed = {};
  std::string style = {};
  std::vector<std::string> keyframes = {};  ///< as --keyframes takes them
};

/// Who dances, as docs/dancers.md describes the file.
struct Dancers {
  std::vector<Dancer> dancers;
  double apart = 0;  ///< metres that stay between two bodies at least
};

/// Reads them of a file of their own, or of a project (project_file.h); key files are named as seen
/// from `folder`. Throws Error(kInvalidArgument) whose field is
/// NAME:dancers[i].MEMBER, naming value and limit.
Dancers ParseDancers(const std::string& text, const std::string& name,
                     const std::filesystem::path& folder);
/// The same of a file. Throws Error(kNotFound) where it is not there, too.
Dancers ReadDancers(const std::filesystem::path& path);

}  // namespace choreo::cli
