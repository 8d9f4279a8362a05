#pragma once

#include <filesystem>

#include "model/evaluation/evaluation.h"

namespace choreo {

/// Pictures for a blind comparison: for each clip with keyed dances (long_plans.h), the first 8 s
/// of the real dance and of `method`'s through the same keys, 12 frames a second, one second per
/// row: A, B, A, B, ... The clip's number decides which is real; a text file, not the picture, says
/// so in one line each: "CLIP A". All files are beside the report `json` (PictureBeside).
void DrawPairedSheets(const ClipSet& set, const Method& method, float temperature,
                      const std::filesystem::path& json);

}  // namespace choreo
