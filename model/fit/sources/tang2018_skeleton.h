#pragma once

#include <span>

#include "model/fit/sources/position_clip.h"
#include "model/fit/sources/sources.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A skeleton made for "Dance with Melody" (Tang et al. 2018), as in paper F's Figure 12, in place
/// of SMPL's.
struct NativeTang2018 {
  Skeleton skeleton;      ///< "tang2018", 23 joints
  SourceMapping mapping;  ///< the recorded points on it
};

/// Makes that skeleton from recordings in metres with Tang2018JointNames. Each bone's length is the
/// mean over clips of its median length. The two temples become one joint, the head. A chest joint
/// is added, which bends against the hips. At rest the legs hang, the arms are held out, and heels
/// and toes are on the floor. Below the elbows the sides differ, as recorded. Throws
/// Error(kInvalidArgument) for no clips, a clip that lacks a joint, or impossible bones.
NativeTang2018 MeasureTang2018(std::span<const PositionClip> clips);

}  // namespace choreo
