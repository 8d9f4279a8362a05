#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "model/core/joined.h"

namespace choreo {

/// What hands do. kRest leaves fingers as the rig has them.
enum class HandPose { kRest, kRelaxed, kOpen, kFist, kPoint };

/// The names by HandPose.
inline constexpr std::array<std::string_view, 5> kHandPoseNames = {"rest", "relaxed", "open",
                                                                   "fist", "point"};

/// The pose of this name, if there is one.
inline std::optional<HandPose> FindHandPose(std::string_view name) {
  const auto found = std::ranges::find(kHandPoseNames, name);
  if (found == kHandPoseNames.end()) return std::nullopt;
  return static_cast<HandPose>(found - kHandPoseNames.begin());
}

/// All of them, for messages.
inline std::string HandPoseNames() { return Joined(kHandPoseNames); }

}  // namespace choreo
