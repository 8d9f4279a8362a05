#pragma once

#include <string_view>

namespace choreo {

// Exit statuses of a program that could not do what it was asked, and that was asked wrongly.
inline constexpr int kFailed = 1;
inline constexpr int kMisused = 2;

/// The models that ship, the default first; behind those that a choreod serves unless told
/// otherwise, the papers' own networks.
inline constexpr std::string_view kEverydayModels[] = {"default", "free"};
inline constexpr std::string_view kShippedModels[] = {"default", "free", "paper-f", "paper-c"};

/// What the first model was called before 0.2.0 where controls were wanted; server and client take
/// it still, with a warning.
inline constexpr std::string_view kFormerControls = "controllers";

}  // namespace choreo
