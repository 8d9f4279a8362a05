#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/training/prepared_clip.h"

namespace choreo {

/// The group of those who train, to which the clips that a splits file does not name belong, too.
inline const char* const kTrainGroup = "train";

/// Which clips training sees, from a splits file {set: {"train": [...], "validation": [...],
/// "test": [...]}}. It sees no other group that the file may have ("test_unseen_genre", "unused").
/// Where two sets name clips alike, a folder holds the clips of the set
/// that is called as it is.
enum class Split { kTrain, kValidation, kTrainAndValidation };

/// Reads every clip of `folders` that belongs to `split`, sorted by folder and name. Throws Error
/// where a folder or the file is missing, the file has a clip of a set in two groups, two clips of
/// `folders` have different skeletons, or nothing is left: then it names the groups that the clips
/// are in.
std::vector<PreparedClip> LoadClips(const std::vector<std::filesystem::path>& folders,
                                    const std::filesystem::path& splits_file, Split split);

/// The same of one group of the file, by its name.
std::vector<PreparedClip> LoadClips(const std::vector<std::filesystem::path>& folders,
                                    const std::filesystem::path& splits_file,
                                    const std::string& group);

}  // namespace choreo
