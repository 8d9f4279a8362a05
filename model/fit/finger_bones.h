#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/core/hand_pose.h"
#include "model/fit/find_bones.h"
#include "model/fit/human_bones.h"

/// The fingers of characters, and the poses of their hands.
namespace choreo {

/// A node of a finger, turned about its own place.
struct CurledBone {
  int node = -1;
  Eigen::Vector3d axis;        ///< of the rig's world at rest, unit
  std::vector<double> angles;  ///< radians: one per frame, or one for all of them
};

/// Hands that take a pose at a time.
struct HandKey {
  double time_s = 0;
  HandPose pose = HandPose::kRelaxed;
};

/// The turns that give both hands a pose. Fingers are the chains below a wrist whose names say
/// thumb, index, middle, ring or pinky, as Mixamo, VRM, Unreal, Rigify and many others do. A finger
/// bends about one axis, across itself towards the palm, whose side follows from wrist and knuckles
/// at rest; a thumb turns towards the middle of the palm. Angles count from straight fingers,
/// those of knuckles from rest, so that a rig that rests with bent ones gets the same pose, and
/// nothing bends back beyond straight.
/// Empty for kRest and for hands without a thumb or a second finger that show where the palm is.
/// Pure.
std::vector<CurledBone> CurlFingers(const RigNodes& rig, const HumanBones& bones, HandPose pose);

/// The same for hands that go from one key to the next, in order of time, at least one; before the
/// first and after the last they keep its pose.
std::vector<CurledBone> CurlFingers(const RigNodes& rig, const HumanBones& bones,
                                    const std::vector<HandKey>& keys, int64_t frames, double fps);

}  // namespace choreo
