#pragma once

#include <string>

#include "model/motion/skeleton.h"

namespace choreo {

/// A skeleton as stored in checkpoints, prepared clips and npz files: a JSON object with name,
/// joint_names, parents, offsets_m ([joints][3]), pelvis_height_m, and the indices of joints with a
/// role (hips, knees, shoulders, elbows: left, right; feet as Skeleton::feet; -1 for none).
std::string SkeletonToJson(const Skeleton& skeleton);

/// The inverse. Throws Error(kInvalidArgument), which names a missing member, and what
/// Skeleton::Check throws.
Skeleton SkeletonFromJson(const std::string& text);

}  // namespace choreo
