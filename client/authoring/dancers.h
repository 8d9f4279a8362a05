#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/authoring/counts.h"

namespace choreo::authoring {

inline constexpr int kMaxDancers = 64;
inline constexpr double kMaxStageRadius = 1000;  ///< metres from its middle along x and z
inline constexpr double kUsuallyApart = 0.2;  ///< metres: dancers do not brush against each other

/// One of several dancers. Members left open have the common value.
struct Dancer {
  std::string id;
  Eigen::Vector2d place = {0, 0};  ///< x and z of the stage where the dance has its origin
  double facing = 0;               ///< degrees that the dance is turned: 90 is along x
  bool mirrored = false;           ///< left is right
  std::optional<WrittenTime> after =
      {};  ///< does everything this much later, and stands still before
  std::optional<uint64_t> seed = {};
  std::string style = {};
  std::vector<std::string> keyframes = {};  ///< own keys, as ReadKeys takes them (key_file.h)
};

/// The dancers of a file; docs/dancers.md describes it.
struct Dancers {
  std::vector<Dancer> dancers;
  double apart = 0;  ///< metres that stay between two bodies at least
};

/// Reads dancers from their own file's JSON or from a project (project_file.h); paths of key files
/// are relative to `folder`. Throws Error(kInvalidArgument) whose field is NAME:dancers[i].MEMBER,
/// naming value and limit.
Dancers ParseDancers(const std::string& text, const std::string& name,
                     const std::filesystem::path& folder);
/// Reads the same from a file. Throws Error(kNotFound), too, if it does not exist.
Dancers ReadDancers(const std::filesystem::path& path);

}  // namespace choreo::authoring
