#pragma once

#include <optional>

#include "model/core/npy.h"
#include "model/formats/motion_reading.h"
#include "model/formats/npz.h"
#include "model/motion/motion.h"

/// Positions of SMPL's joints without rotations, as HumanML3D and many networks give them. Private
/// to this folder.
namespace choreo {

/// The array joints, joints3d, joint_positions, positions or pred_position of an archive, if any,
/// as [..., joints, 3].
std::optional<NpyArray> FindJointArray(const NpzArchive& npz);

/// Whether they are positions: [F, 22 or 24, 3], also in a batch of one, with constant limb
/// lengths, which rotation vectors lack. Reads the first of several people, [people, F, ...].
bool AreJointPlaces(const NpyArray& array);

/// SMPL's body fitted to them (fit/fit_clip.h), in its size and on the floor; the rotations of
/// head, hands and feet are guesses, which is noted. `fps` is the file's. Throws
/// Error(kInvalidArgument) if AreJointPlaces is false.
Motion ReadJointPlaces(const NpyArray& array, double fps, const MotionReading& reading);

}  // namespace choreo
