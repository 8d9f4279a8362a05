#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/training/clips/prepared_clip.h"

namespace choreo {

/// Groups in a splits file {set: {"train": [...], "validation": [...], "test": [...]}}, which may
/// have others ("test_unseen_genre", "unused"). Clips that are not listed are in "train".
inline const char* const kTrainGroup = "train";
inline const char* const kValidationGroup = "validation";

/// Reads all clips of `folders` in the group `requested`, sorted by folder and name. If two sets
/// share clip names, a folder's clips belong to the set with the folder's name. Throws Error if a
/// folder or the file is missing, the file has a clip in two groups, or two clips have different
/// skeletons; and, naming the clips' groups, if no clip is in the group.
std::vector<PreparedClip> LoadClips(const std::vector<std::filesystem::path>& folders,
                                    const std::filesystem::path& splits_file,
                                    const std::string& requested);

}  // namespace choreo
