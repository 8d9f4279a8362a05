#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/training/prepared_clip.h"

namespace choreo {

/// Groups in a splits file {set: {"train": [...], "validation": [...], "test": [...]}}; others may
/// exist ("test_unseen_genre", "unused"). Unlisted clips train.
inline const char* const kTrainGroup = "train";
inline const char* const kValidationGroup = "validation";

/// Reads all clips of `folders` in the group `wanted`, sorted by folder and name. If two sets share
/// clip names, a folder holds the clips of the set with its name. Throws Error if a folder or the
/// file is missing, the file has a clip in two groups, two clips of `folders` have different
/// skeletons, or nothing is left: then it names the groups that the clips are in.
std::vector<PreparedClip> LoadClips(const std::vector<std::filesystem::path>& folders,
                                    const std::filesystem::path& splits_file,
                                    const std::string& wanted);

}  // namespace choreo
