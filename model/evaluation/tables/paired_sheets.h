#pragma once

#include <filesystem>

#include "model/evaluation/evaluation.h"

namespace choreo {

/// Draws pictures for a blind comparison: for each clip with keyed dances (long_plans.h), the first
/// 8 s of the real dance and of `method`'s through the same keys, 12 frames per second, one second
/// per row: A, B, A, B, ... The clip's number decides which is real. Only a text file reveals it,
/// in one line per clip: "CLIP A". All files are beside the report `json` (PictureBeside).
void DrawPairedSheets(const ClipSet& set, const Method& method, float temperature,
                      const std::filesystem::path& json);

}  // namespace choreo
