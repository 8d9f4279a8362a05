#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/fit/human_bones.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A character's rig, whatever its rest pose, its facing and its bones' frames, as a skeleton of
/// ours that stands at rest as SMPL's does: arms out to the sides, limbs in SMPL's directions, feet
/// flat, in the character's own unit and proportions.
struct CharacterBody {
  /// Joints are named as HumanBones names them; toes that the rig lacks are added.
  Skeleton skeleton;
  std::vector<int> nodes;  ///< [joints] index in the rig; -1 for added toes
  /// [joints] Turns of the world that lead from the rig's rest pose to the skeleton's.
  std::vector<Eigen::Matrix3d> turns;
};

/// `places` [3, nodes]: where the rig's nodes stand at rest, upright, in any facing. The floor is
/// y = 0, or just below feet that stand elsewhere. Throws Error(kInvalidArgument) whose field is
/// `bones`: for one that is needed and missing (pelvis, neck or head, and on both sides hip, knee,
/// ankle, shoulder, elbow, wrist), two that are one node or stand in one place, and left and right
/// exchanged.
CharacterBody MakeCharacterBody(const HumanBones& bones, const Eigen::Matrix3Xd& places);

/// The first bone that is needed and missing; empty where none is.
std::string MissingBone(const HumanBones& bones);

}  // namespace choreo
