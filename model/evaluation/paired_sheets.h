#pragma once

#include <filesystem>

#include "model/evaluation/evaluation.h"

namespace choreo {

/// Pictures for the eye to guess by: of each clip that has keyed dances (long_plans.h) the first
/// 8 s as they were really danced and as `method` dances them through the same keys, 12 frames a
/// second, a row a second: A, B, A, B, ... Which of the two is real is drawn for each clip by its
/// number, and not on the picture, but in a text file, a line each: "CLIP A". All files stand
/// beside the report `json` (PictureBeside).
void DrawPairedSheets(const ClipSet& set, const Method& method, float temperature,
                      const std::filesystem::path& json);

}  // namespace choreo
