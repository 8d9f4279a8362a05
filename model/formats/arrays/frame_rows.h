#pragma once

#include <optional>
#include <string>

#include "model/core/files/npy.h"
#include "model/formats/reading/motion_reading.h"
#include "model/motion/motion.h"

/// Reads a motion of SMPL's body from one array with a row per frame, as dance networks and data
/// sets write it. The width of a row determines its kind. Private to this folder.
///
/// | numbers   | of        | are                                                              |
/// |-----------|-----------|------------------------------------------------------------------|
/// | 135, 139  | LODGE     | (4 contacts,) place, 6D of 22 joints                             |
/// | 315, 319  | FineDance | the same of 52 joints                                            |
/// | 151       | EDGE      | 4 contacts, place of the pelvis, 6D of 24 joints; Z is up        |
/// | 219, 225  | AIST++    | (6 zeros,) place, matrices of 24 joints, as FACT's repository    |
/// |           |           | google-research/mint has them (issues 4, 5 and 54)               |
/// | 322       | Motion-X  | turns of SMPL-X's body, hands and jaw, a face, place and betas   |
/// | 263       | HumanML3D | how the root moves, places seen from it, 6D, speeds, contacts    |
///
/// HumanML3D's 6D are not rotations of SMPL's bones, so only its positions are read
/// (joint_arrays.h).
namespace choreo {

/// Reads the motion at its kind's rate or at `reading.fps`, and notes the kind. None if no kind has
/// this width. Throws Error(kInvalidArgument) for numbers that the kind cannot contain, such as
/// normalised ones.
std::optional<Motion> ReadFrameRows(const NpyArray& array, const MotionReading& reading);

/// "135, 139, ...", for messages.
std::string FrameRowWidths();

}  // namespace choreo
