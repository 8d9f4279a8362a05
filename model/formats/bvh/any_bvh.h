#pragma once

#include <filesystem>

#include "model/formats/reading/motion_reading.h"
#include "model/motion/skeleton.h"
#include "model/motion/skeleton_motion.h"

namespace choreo {

/// Reads a BVH file of any skeleton. The motion is unchanged if the skeleton is `preferred` (if
/// given), SMPL's, or another one in our conventions; otherwise it is fitted to SMPL's body. Angles
/// that look like radians count as radians, unless `reading` states the unit.
SkeletonMotion ReadAnyBvh(const std::filesystem::path& path, const Skeleton* preferred,
                          const MotionReading& reading);

}  // namespace choreo
