#pragma once

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Transfers a dance from SMPL's body to a character's (character_body.h), whose rest pose is
/// SMPL's. Bones take the world rotations of SMPL's. A trunk or neck with more or fewer bones bends
/// as much in all. All functions are pure and work frame by frame.
namespace choreo {

/// The height of the character's hips above its ankles at rest over SMPL's, which scales travel.
double CharacterSize(const Skeleton& character);

/// Copies the bones' world rotations, and the hips' position scaled by CharacterSize.
Motion CopyTurns(const Motion& smpl, const Skeleton& character);

/// Corrects the limbs of `copied` (consecutive frames) by inverse kinematics
/// (motion/kinematics/limb.h). Toes move to SMPL's positions, scaled, with flat feet at the floor.
/// Hands that touch or nearly touch each other, the head, the thighs or the floor keep SMPL's
/// distance from them, scaled.
Motion PlaceLimbs(const Motion& smpl, const Skeleton& character, Motion copied);

/// CopyTurns, then PlaceLimbs. Throws Error(kInvalidArgument) if a pose's joint count is not
/// SMPL's.
Motion TransferToCharacter(const Motion& smpl, const Skeleton& character);

}  // namespace choreo
