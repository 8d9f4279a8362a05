#pragma once

#include <filesystem>

#include "model/formats/motion_file.h"

/// Motion files that a command reads.
namespace choreo::cli {

/// As ReadMotion (formats/motion_file.h); what the reading notes stands on stderr, each line once
/// however often the file is read. Of the options that these lines name, `convert` has all; others
/// are told so.
SkeletonMotion ReadMotionNoting(const std::filesystem::path& path);
SkeletonMotion ReadMotionNoting(const std::filesystem::path& path, MotionReading reading);
Motion ReadMotionNoting(const std::filesystem::path& path, const Skeleton& skeleton,
                        OtherSkeleton other = OtherSkeleton::kRetarget);

}  // namespace choreo::cli
