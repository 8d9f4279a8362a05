#pragma once

#include <optional>

#include "model/core/npy.h"
#include "model/formats/motion_reading.h"
#include "model/formats/npz.h"
#include "model/motion/motion.h"

/// Places of SMPL's joints without rotations, as HumanML3D and many networks give them. Private to
/// this folder.
namespace choreo {

/// The array joints, joints3d, joint_positions, positions or pred_position of an archive, if there
/// is one, as [..., joints, 3].
std::optional<NpyArray> FindJointArray(const NpzArchive& npz);

/// Whether they are places: [F, 22 or 24, 3], also in a batch of one, whose limbs keep their
/// lengths. Rotation vectors do not. Of several people, [people, F, ...], the first is looked at.
bool AreJointPlaces(const NpyArray& array);

/// SMPL's body fitted to them (fit/fit_clip.h), in its size and on the floor; how head, hands and
/// feet are turned is a guess, which is noted. `fps` is the file's. Throws
/// Error(kInvalidArgument) where AreJointPlaces is false.
Motion ReadJointPlaces(const NpyArray& array, double fps, const MotionReading& reading);

}  // namespace choreo
