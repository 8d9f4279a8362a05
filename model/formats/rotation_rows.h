#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/formats/motion_reading.h"
#include "model/formats/npz.h"

namespace choreo {

/// Whether rotations of one of these numbers of `joints` may have this width.
bool AreRotations(int64_t width, const std::vector<int64_t>& joints);

/// Rotation vectors [3 joints, frames], and whether they are stated as such, so that they have a
/// unit.
struct RotationRows {
  Eigen::MatrixXd turns;
  bool are_vectors = false;
};

/// Converts rotations of any form, for one of these numbers of `joints` per frame, to rotation
/// vectors. The forms are vectors [F, 3 J] or [F, J, 3]; matrices [F, J, 3, 3],
/// [F, J, 9] or [F, 9 J]; 6D, [F, J, 6] or [F, 6 J], the first two rows of a matrix as in PyTorch3D
/// or, if knees and elbows would bend the wrong way, its first two columns as Zhou et al. 2019 do,
/// or these as [F, J, 3, 2] lies; quaternions, [F, J, 4] or [F, 4 J] of several joints, whose real
/// part is the larger of first and last. F may be preceded by a batch of one, and a single frame
/// needs no F. Throws Error(kInvalidArgument) naming the array, its shape or the invalid rotation,
/// and for 6D whose vectors are far from unit length and right angles.
RotationRows ReadRotationRows(const NpzArchive& npz, const std::string& key,
                              const std::vector<int64_t>& joints);

/// Converts degrees to radians if `reading` says so or, with a note, if most frames have a joint
/// other than the first turned by more than two whole turns. Throws Error(kInvalidArgument), whose
/// field is --angles, if that is given for rotations without a unit.
void ToRadians(const std::string& key, const MotionReading& reading, RotationRows* rows);

}  // namespace choreo
