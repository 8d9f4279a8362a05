#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "model/fit/find_bones.h"
#include "model/fit/human_bones.h"

/// The fingers of characters, and the poses of their hands.
namespace choreo {

/// What hands do. kRest leaves fingers as the rig has them.
enum class HandPose { kRest, kRelaxed, kOpen, kFist, kPoint };

/// By HandPose.
inline constexpr std::array<std::string_view, 5> kHandPoseNames = {"rest", "relaxed", "open",
                                                                   "fist", "point"};

/// A node of a finger, turned about its own place.
struct CurledBone {
  int node = -1;
  Eigen::Vector3d axis;  ///< of the rig's world at rest, unit
  double angle = 0;      ///< radians
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

}  // namespace choreo
