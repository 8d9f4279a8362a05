#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/core/hand_pose.h"
#include "model/fit/bones/find_bones.h"
#include "model/fit/bones/human_bones.h"

/// The fingers of characters, and the poses of their hands.
namespace choreo {

/// A node of a finger and its rotation about its own position.
struct CurledBone {
  int node = -1;
  Eigen::Vector3d axis;        ///< in the rig's world at rest, unit length
  std::vector<double> angles;  ///< radians: one per frame, or one for all of them
};

/// A pose of both hands at a time.
struct HandKey {
  double time_s = 0;
  HandPose pose = HandPose::kRelaxed;
};

/// Computes the rotations that give both hands a pose. Fingers are the chains below a wrist whose
/// names contain thumb, index, middle, ring or pinky, as in Mixamo, VRM, Unreal, Rigify and many
/// other rigs. A finger bends about one axis, across itself, towards the palm, whose side follows
/// from wrist and knuckles at rest. A thumb turns towards the middle of the palm. Angles count from
/// straight fingers, at knuckles from rest, so a rig that rests with bent fingers gets the same
/// pose. Nothing bends back beyond straight. Empty for kRest, and for hands without a thumb or a
/// second finger, whose palm is unknown. Pure.
std::vector<CurledBone> CurlFingers(const RigNodes& rig, const HumanBones& bones, HandPose pose);

/// The same for hands that move from key to key: at least one key, in order of time. Before the
/// first and after the last key the hands hold its pose.
std::vector<CurledBone> CurlFingers(const RigNodes& rig, const HumanBones& bones,
                                    const std::vector<HandKey>& keys, int64_t frames, double fps);

}  // namespace choreo
