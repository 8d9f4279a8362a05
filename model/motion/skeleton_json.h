#pragma once

#include <string>

#include "model/motion/skeleton.h"

namespace choreo {

/// A skeleton as checkpoints, prepared clips and npz files carry it: one JSON object with name,
/// joint_names, parents, offsets_m ([joints][3]), pelvis_height_m, and the joints that play a role
/// by index (hips, knees, shoulders, elbows: left, right; feet as Skeleton::feet; -1 for none).
std::string SkeletonToJson(const Skeleton& skeleton);

/// Throws Error(kInvalidArgument) for text that is no such object, naming what is missing, or for a
/// skeleton that Skeleton::Validate refuses.
Skeleton SkeletonFromJson(const std::string& text);

}  // namespace choreo
