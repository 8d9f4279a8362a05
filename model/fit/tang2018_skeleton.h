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
/// over the clips of its median length.
///
/// As many joints as recorded points, but not quite the same: a skeleton of rotations needs a joint
/// wherever the body bends. Recorded are 21 of them: the waist (the root, a point on the belly) and
/// hip, knee, ankle, heel, toes, shoulder, elbow, wrist, hand and thumb of either side. The two
/// temples are points of one bone, the head; it turns about its joint halfway between shoulders and
/// temples. The joint that this leaves over is the chest, which carries shoulders and head and
/// bends against the hips: without it the dance would have lost its hips.
///
/// At rest: legs straight down, the waist 19 degrees in front of the hips' vertical (every genre's
/// median), the chest's joint above the hips at the waist's height, shoulders and head straight
/// above it, arms held out sideways, heels and toes on the floor. Trunk, legs and upper arms are
/// mirror images; the points below the elbows are not at the same places on the two sides of the
/// recordings, and stay where they are.
///
/// Throws Error(kInvalidArgument) for no clips, a clip that lacks a joint, or bones that no body
/// has.
NativeTang2018 MeasureTang2018(std::span<const PositionClip> clips);

}  // namespace choreo
