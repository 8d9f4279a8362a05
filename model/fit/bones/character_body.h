#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/fit/bones/human_bones.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A character's rig as a skeleton that rests like SMPL's: arms out to the sides, limbs in SMPL's
/// directions, feet flat. It keeps the character's unit and proportions, and does not depend on the
/// rig's rest pose, facing and bone frames.
struct CharacterBody {
  /// Its joints have the names of HumanBones. Missing toes are added.
  Skeleton skeleton;
  std::vector<int> nodes;  ///< [joints] index in the rig; -1 for added toes
  /// [joints] World rotations from the rig's rest pose to the skeleton's.
  std::vector<Eigen::Matrix3d> turns;
};

/// Makes the body from the rest positions of the rig's nodes, `places` [3, nodes], upright, facing
/// any way. The floor is y = 0, or just below the feet if they are elsewhere. Throws
/// Error(kInvalidArgument) whose field is `bones` if a needed bone is missing (pelvis, neck or
/// head, and on both sides hip, knee, ankle, shoulder, elbow, wrist), if two bones are one node or
/// at one place, or if left and right are swapped.
CharacterBody MakeCharacterBody(const HumanBones& bones, const Eigen::Matrix3Xd& places);

/// The needed bones that are missing, as in "left_hip, left_knee and 4 more"; empty if none is.
std::string MissingBones(const HumanBones& bones);

}  // namespace choreo
