#pragma once

#include <span>

#include "model/fit/position_clip.h"
#include "model/fit/sources.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// "Dance with Melody" (Tang et al. 2018) on a skeleton of its own, as paper F's Figure 12 has it,
/// instead of SMPL's.
struct NativeTang2018 {
  Skeleton skeleton;      ///< "tang2018", 23 joints
  SourceMapping mapping;  ///< where the recorded points stand on it
};

/// Makes that skeleton from recordings in metres with Tang2018JointNames: every bone has the mean
/// over the clips of its median length. Of the points the two temples are one joint, the head; the
/// chest, which bends against the hips, is added. At rest legs hang, arms are held out, heels and
/// toes stand on the floor. Below the elbows the sides differ, as recorded. Throws
/// Error(kInvalidArgument) for no clips, a clip that lacks a joint, or bones that no body has.
NativeTang2018 MeasureTang2018(std::span<const PositionClip> clips);

}  // namespace choreo
