#pragma once

#include <filesystem>

#include "model/evaluation/method.h"
#include "model/evaluation/windows.h"

namespace choreo {

inline constexpr int kSheetTransitions = 10;
inline constexpr int kSheetFrames = 60;

/// A picture of ten transitions of one method, one a row, for the eye to judge what figures don't
/// say: eight poses evenly from the history's last one to the key, which is framed. Windows are
/// drawn at random from the set with a fixed seed, the same for every method.
void DrawMethodSheet(const ClipSet& set, const Method& method, const ModelInfo& model,
                     float temperature, const std::filesystem::path& png);

}  // namespace choreo
