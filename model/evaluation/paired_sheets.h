#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "model/evaluation/evaluation.h"

namespace choreo {

inline constexpr int kPairedSeconds = 8;
inline constexpr int kPairedFrames = 12;  ///< a second

/// Pictures for the eye to guess by: of each clip that has keyed dances (long_plans.h) the first
/// 8 s as they were really danced and as `method` dances them through the same keys, 12 frames a
/// second, a row a second: A, B, A, B, ... Which of the two is real is drawn for each clip by its
/// number, and not on the picture. `png(clip)` says where a clip's picture goes. Returns the
/// answers, a line each: "CLIP A".
std::string DrawPairedSheets(const ClipSet& set, const Method& method, float temperature,
                             const std::function<std::filesystem::path(const std::string&)>& png);

}  // namespace choreo
