#pragma once

#include <span>

#include "model/fit/position_clip.h"
#include "model/fit/sources.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// "Dance with Melody" (Tang et al. 2018) on a skeleton of its own, as in paper F's Figure 12,
/// instead of SMPL's.
struct NativeTang2018 {
  Skeleton skeleton;      ///< "tang2018", 23 joints
  SourceMapping mapping;  ///< where the recorded points lie on it
};

/// Makes that skeleton from recordings in metres with Tang2018JointNames: each bone has the mean
/// over clips of its median length. The two temples become one joint, the head; a chest joint,
/// which bends against the hips, is added. At rest legs hang, arms are held out, heels and toes are
/// on the floor. Below the elbows the sides differ, as recorded. Throws Error(kInvalidArgument) for
/// no clips, a clip that lacks a joint, or impossible bones.
NativeTang2018 MeasureTang2018(std::span<const PositionClip> clips);

}  // namespace choreo
