#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/training/prepared_clip.h"

namespace choreo {

/// Groups of a splits file {set: {"train": [...], "validation": [...], "test": [...]}}, which may
/// have others ("test_unseen_genre", "unused"). Clips that it does not name belong to those who
/// train.
inline const char* const kTrainGroup = "train";
inline const char* const kValidationGroup = "validation";

/// Reads every clip of `folders` of the group `wanted`, sorted by folder and name. Where
/// two sets name clips alike, a folder holds the clips of the set that is called as it is. Throws
/// Error where a folder or the file is missing, the file has a clip of a set in two groups, two
/// clips of `folders` have different skeletons, or nothing is left: then it names the groups that
/// the clips are in.
std::vector<PreparedClip> LoadClips(const std::vector<std::filesystem::path>& folders,
                                    const std::filesystem::path& splits_file,
                                    const std::string& wanted);

}  // namespace choreo
