#pragma once

#include <filesystem>

#include "model/formats/motion_reading.h"
#include "model/motion/skeleton.h"
#include "model/motion/skeleton_motion.h"

namespace choreo {

/// Reads a BVH file of any skeleton: unchanged if it is `wanted` (if any), SMPL's, or one of its
/// own in our conventions, otherwise fitted to SMPL's. Angles that look like radians are taken as
/// such, unless `reading` says what they are.
SkeletonMotion ReadAnyBvh(const std::filesystem::path& path, const Skeleton* wanted,
                          const MotionReading& reading);

}  // namespace choreo
