#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "model/core/joined.h"

namespace choreo {

/// A hand's pose. kRest leaves the fingers in the rig's rest pose.
enum class HandPose { kRest, kRelaxed, kOpen, kFist, kPoint };

/// Names, indexed by HandPose.
inline constexpr std::array<std::string_view, 5> kHandPoseNames = {"rest", "relaxed", "open",
                                                                   "fist", "point"};

/// The pose with this name, or none.
inline std::optional<HandPose> FindHandPose(std::string_view name) {
  const auto found = std::ranges::find(kHandPoseNames, name);
  if (found == kHandPoseNames.end()) return std::nullopt;
  return static_cast<HandPose>(found - kHandPoseNames.begin());
}

/// All names, for messages.
inline std::string HandPoseNames() { return Joined(kHandPoseNames); }

}  // namespace choreo
