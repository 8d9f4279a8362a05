#pragma once

#include <optional>
#include <string>

#include "model/core/npy.h"
#include "model/formats/motion_reading.h"
#include "model/motion/motion.h"

/// One array that holds a whole motion of SMPL's body, a row a frame, as networks and data sets of
/// dance write it. How wide a row is says what it holds. Private to this folder.
///
/// | numbers   | of        | are                                                              |
/// |-----------|-----------|------------------------------------------------------------------|
/// | 135, 139  | LODGE     | (4 contacts,) place, 6D of 22 joints                             |
/// | 315, 319  | FineDance | the same of 52 joints                                            |
/// | 151       | EDGE      | 4 contacts, place of the pelvis, 6D of 24 joints; Z is up        |
/// | 219, 225  | AIST++    | (6 zeros,) place, matrices of 24 joints, as FACT has them        |
/// | 322       | Motion-X  | turns of SMPL-X's body, hands and jaw, a face, place and betas   |
/// | 263       | HumanML3D | how the root moves, places seen from it, 6D, speeds, contacts    |
///
/// Of the last the places alone are read (joint_arrays.h): its 6D are no turns of SMPL's bones.
namespace choreo {

/// The motion, at the rate that its kind has, or at `reading.fps`; what it was taken for is noted.
/// Nothing where no kind is so wide. Throws Error(kInvalidArgument) for one whose numbers cannot be
/// of that kind, as where they are normalised.
std::optional<Motion> ReadFrameRows(const NpyArray& array, const MotionReading& reading);

/// "135, 139, ...", for messages.
std::string FrameRowWidths();

}  // namespace choreo
