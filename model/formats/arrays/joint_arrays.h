#pragma once

#include <optional>

#include "model/core/files/npy.h"
#include "model/formats/containers/npz.h"
#include "model/formats/reading/motion_reading.h"
#include "model/motion/motion.h"

/// Reads positions of SMPL's joints without rotations, as HumanML3D and many networks write them.
/// Private to this folder.
namespace choreo {

/// An archive's array joints, joints3d, joint_positions, positions or pred_position, if any, as
/// [..., joints, 3].
std::optional<NpyArray> FindJointArray(const NpzArchive& npz);

/// Whether an array holds positions, [F, 22 or 24, 3] or a batch of one: unlike rotation vectors,
/// they have constant limb lengths. Considers the first of several people, [people, F, ...].
bool AreJointPlaces(const NpyArray& array);

/// Fits SMPL's body, at its own size and on the floor, to the positions (fit/solver/fit_clip.h).
/// Notes that the rotations of head, hands and feet are guesses. `fps` is the file's. Throws
/// Error(kInvalidArgument) if AreJointPlaces is false.
Motion ReadJointPlaces(const NpyArray& array, double fps, const MotionReading& reading);

}  // namespace choreo
