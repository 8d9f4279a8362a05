#pragma once

#include "model/fit/position_clip.h"
#include "model/fit/sources.h"

namespace choreo {

/// A recording of a BVH hierarchy, by its joint names (human_bones.h). End sites are named after
/// their parent + "_end". The spine's proportions are measured on the clip. Throws
/// Error(kInvalidArgument) naming the first joint of those needed that is missing: hips, knees,
/// ankles, shoulders, elbows, wrists, neck.
SourceMapping BvhSource(const PositionClip& clip);

}  // namespace choreo
