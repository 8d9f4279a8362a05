#pragma once

#include <string_view>

namespace choreo {

// Exit statuses: of a program that failed, and of one that was called with wrong arguments.
inline constexpr int kFailed = 1;
inline constexpr int kMisused = 2;

/// The models that ship, the default first. choreod serves them unless configured otherwise. The
/// papers' own networks follow.
inline constexpr std::string_view kEverydayModels[] = {"default", "free"};
inline constexpr std::string_view kShippedModels[] = {"default", "free", "paper-f", "paper-c"};

/// The name of "default" with controls before 0.2.0. Server and client still accept it, with a
/// warning.
inline constexpr std::string_view kFormerControls = "controllers";

}  // namespace choreo
