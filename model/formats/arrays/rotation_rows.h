#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/formats/containers/npz.h"
#include "model/formats/reading/motion_reading.h"

namespace choreo {

/// Whether rows of this width may hold rotations of as many joints as one of `joints`.
bool AreRotations(int64_t width, const std::vector<int64_t>& joints);

/// Rotation vectors [3 * joints, frames], and whether the file states rotation vectors, whose
/// angles have a unit.
struct RotationRows {
  Eigen::MatrixXd turns;
  bool are_vectors = false;
};

/// Converts rotations of any form, of as many joints as one of `joints`, to rotation vectors. The
/// forms are vectors [F, 3 J] or [F, J, 3]; matrices [F, J, 3, 3], [F, J, 9] or [F, 9 J]; 6D, [F,
/// J, 6] or [F, 6 J], the first two rows of a matrix as in PyTorch3D or, if knees and elbows would
/// bend the wrong way, its first two columns as Zhou et al. 2019 do, or these interleaved as [F, J,
/// 3, 2]; quaternions, [F, J, 4] or [F, 4 J] of several joints, whose real part is first or last,
/// whichever is larger. A batch of one may precede F, and a single frame needs no F. Throws
/// Error(kInvalidArgument), naming the array, its shape or the invalid rotation, and for 6D whose
/// vectors are far from orthonormal.
RotationRows ReadRotationRows(const NpzArchive& npz, const std::string& key,
                              const std::vector<int64_t>& joints);

/// Converts degrees to radians if `reading` states degrees or, with a note, if in most frames a
/// joint other than the first turns by more than two whole turns. Throws Error(kInvalidArgument),
/// whose field is --angles, if that is given for rotations without a unit.
void ToRadians(const std::string& key, const MotionReading& reading, RotationRows* rows);

}  // namespace choreo
