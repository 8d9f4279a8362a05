#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "client/authoring/fields/counts.h"
#include "client/authoring/keys/dance_keys.h"

namespace choreo::authoring {

inline constexpr int kMaxDancers = 64;
inline constexpr double kMaxStageRadius = 1000;  ///< metres from its middle along x and z
inline constexpr double kUsuallyApart = 0.2;     ///< metres, so that dancers do not touch

/// One of several dancers. Empty members have the value common to all dancers.
struct Dancer {
  std::string id;
  Eigen::Vector2d place = {0, 0};  ///< where the dance's origin is on the stage, x and z
  double facing = 0;               ///< degrees by which the dance is turned: 90 is along x
  bool mirrored = false;           ///< swaps left and right
  std::optional<WrittenTime> after =
      {};  ///< the whole dance's delay, during which the dancer stands still
  std::optional<uint64_t> seed = {};
  std::string style = {};
  std::vector<std::string> keyframes = {};  ///< own keys: sources for ReadKeys (key_file.h)
  std::optional<DanceKeys> own_keys = {};   ///< in a Project: what `keyframes` say
};

/// The dancers of a file; docs/dancers.md describes it.
struct Dancers {
  std::vector<Dancer> dancers = {};
  double apart = kUsuallyApart;  ///< least distance between two bodies, metres
};

/// Checks ids, places and angles. Throws Error(kInvalidArgument) whose field is
/// NAME:dancers[i].MEMBER, naming value and limit.
void CheckDancers(const Dancers& stage, const std::string& name);

/// Reads dancers from a parsed dancers' file or project (project_file.h). Paths of key
/// files are relative to `folder`. Throws as CheckDancers does.
Dancers ParseDancers(const nlohmann::json& file, const std::string& name,
                     const std::filesystem::path& folder);
/// Reads dancers from a file. Throws as ParseDancers does, and Error(kNotFound) if the file does
/// not exist.
Dancers ReadDancers(const std::filesystem::path& path);

}  // namespace choreo::authoring
