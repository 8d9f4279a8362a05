#pragma once

#include <string_view>

namespace choreo {

// Exit statuses: kFailed for a failure, kMisused for wrong arguments.
inline constexpr int kFailed = 1;
inline constexpr int kMisused = 2;

/// The models that choreod serves unless configured otherwise, the default first; and all models
/// that ship, the papers' own networks last.
inline constexpr std::string_view kEverydayModels[] = {"default", "free"};
inline constexpr std::string_view kShippedModels[] = {"default", "free", "paper-f", "paper-c"};

/// The former name, until 0.2.0, of "default" with controls. Server and client still accept it,
/// with a warning.
inline constexpr std::string_view kFormerControls = "controllers";

}  // namespace choreo
