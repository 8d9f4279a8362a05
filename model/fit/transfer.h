#pragma once

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Transfers a dance from SMPL's body to a character's (character_body.h), whose rest pose is
/// SMPL's. Bones turn in the world as SMPL's do; a trunk or neck with more or fewer bones bends as
/// much in total. All functions are pure and per frame; motions have one pose a frame.
namespace choreo {

/// Height of the character's hips above its ankles at rest, over SMPL's: the scale of its travel.
double CharacterSize(const Skeleton& character);

/// Copies the bones' rotations, and the hips' position scaled by CharacterSize.
Motion CopyTurns(const Motion& smpl, const Skeleton& character);

/// Corrects the limbs of `copied` (consecutive frames) by inverse kinematics (motion/limb.h): toes
/// go where SMPL's are, scaled, with flat feet at the floor; hands that touch or nearly touch each
/// other, the head, the thighs or the floor keep SMPL's distance from it, scaled.
Motion PlaceLimbs(const Motion& smpl, const Skeleton& character, Motion copied);

/// CopyTurns, then PlaceLimbs. Throws Error(kInvalidArgument) for poses of another joint count than
/// SMPL's.
Motion TransferToCharacter(const Motion& smpl, const Skeleton& character);

}  // namespace choreo
