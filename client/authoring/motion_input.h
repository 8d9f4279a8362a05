#pragma once

#include <filesystem>

#include "model/formats/motion_file.h"

/// Motion files that a command reads.
namespace choreo::authoring {

/// Reads like ReadMotion (formats/motion_file.h). Prints its notes to stderr, each line once even
/// if the file is read again. Only `convert` has all the options that notes name; for other
/// commands the note says so.
SkeletonMotion ReadMotionNoting(const std::filesystem::path& path);
SkeletonMotion ReadMotionNoting(const std::filesystem::path& path, MotionReading reading);
Motion ReadMotionNoting(const std::filesystem::path& path, const Skeleton& skeleton,
                        OtherSkeleton other = OtherSkeleton::kRetarget);

}  // namespace choreo::authoring
