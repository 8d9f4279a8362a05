#pragma once

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// A dance of SMPL's body on the body of a character (character_body.h), whose rest pose is SMPL's.
/// Bones turn in the world as SMPL's do; a trunk or neck of more or fewer bones bends in all as
/// much. All functions are pure and look at one frame at a time; motions have one pose a frame.
namespace choreo {

/// The character's height of the hips above the ankles at rest, over SMPL's: what scales its ways.
double CharacterSize(const Skeleton& character);

/// Turns of the bones, and the place of the hips, scaled by CharacterSize.
Motion CopyTurns(const Motion& smpl, const Skeleton& character);

/// Puts the limbs of `copied`, consecutive frames, where they belong, by inverse kinematics
/// (motion/limb.h): toes where SMPL's are, scaled, as high above the floor as flat feet are there
/// and here; and hands that touch, or nearly, each other, the head, the thighs or the floor, as far
/// from there as SMPL's, scaled.
Motion PlaceLimbs(const Motion& smpl, const Skeleton& character, Motion copied);

/// Both. Throws Error(kInvalidArgument) for poses of another joint count than SMPL's.
Motion TransferToCharacter(const Motion& smpl, const Skeleton& character);

}  // namespace choreo
