#pragma once

#include "model/fit/position_clip.h"
#include "model/fit/sources.h"

namespace choreo {

/// A recording of a BVH hierarchy, by its joint names:
/// Hips/LeftUpLeg/LeftLeg/LeftFoot/LeftToeBase... (dancedb, LAFAN1, Mixamo with its prefix,
/// conversions of CMU), hip/lThigh/lShin/lFoot... (Poser-style, cmu_dance),
/// Hips/LeftHip/LeftKnee/LeftAnkle, LeftCollar/LeftShoulder/LeftElbow/LeftWrist (perfume) and
/// CC_Base_L_Thigh/CC_Base_L_Calf/CC_Base_L_Foot... (iClone, cmu_modern). End sites are named after
/// their parent + "_end". The spine's proportions are measured on the clip. Throws
/// Error(kInvalidArgument) naming the first joint of those needed that is missing: hips, knees,
/// ankles, shoulders, elbows, wrists, neck.
SourceMapping BvhSource(const PositionClip& clip);

}  // namespace choreo
