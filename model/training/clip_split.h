#pragma once

#include <filesystem>
#include <vector>

#include "model/training/prepared_clip.h"

namespace choreo {

/// Which clips a run sees, from a splits file {set: {"train": [...], "validation": [...], "test":
/// [...]}}. Clips that it does not name belong to training.
enum class Split { kTrain, kValidation, kTest, kTrainAndValidation };

/// Reads every clip of `folders` that belongs to `split`, sorted by folder and name. Throws Error
/// where the file is missing, nothing is left, or
/// two clips of `folders` have different skeletons.
std::vector<PreparedClip> LoadClips(const std::vector<std::filesystem::path>& folders,
                                    const std::filesystem::path& splits_file, Split split);

}  // namespace choreo
