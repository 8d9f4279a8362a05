#pragma once

#include <filesystem>

#include "model/formats/motion_file.h"

/// Reads motion files for commands.
namespace choreo::authoring {

/// Reads a motion like ReadMotion (formats/motion_file.h). Its notes go to the sink (notes.h), each
/// line once even if the file is read again. Notes name options that only `convert` has, and say
/// so.
SkeletonMotion ReadMotionNoting(const std::filesystem::path& path);
SkeletonMotion ReadMotionNoting(const std::filesystem::path& path, MotionReading reading);
Motion ReadMotionNoting(const std::filesystem::path& path, const Skeleton& skeleton,
                        OtherSkeleton other = OtherSkeleton::kRetarget);

}  // namespace choreo::authoring
