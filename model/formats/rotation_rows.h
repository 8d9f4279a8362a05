#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/formats/npz.h"

namespace choreo {

/// Whether rotations of one of `joints` joints may be so many numbers.
bool AreRotations(int64_t width, const std::vector<int64_t>& joints);

/// The rotations of one of `joints` joints in each frame, whatever they are stated as, as rotation
/// vectors [3 joints, frames]: vectors [F, 3 J] or [F, J, 3]; matrices [F, J, 3, 3], [F, J, 9] or
/// [F, 9 J]; 6D, [F, J, 6] or [F, 6 J], the first two rows of a matrix as PyTorch3D has them or,
/// where knees and elbows then bend the wrong way, its first two columns as Zhou et al. 2019 do, or
/// these as [F, J, 3, 2] lies; quaternions, [F, J, 4] or [F, 4 J] of several joints, whose real
/// part is the larger of first and last. A batch of one may stand before F, and a single frame
/// needs no F. Throws Error(kInvalidArgument) naming the array, its shape or the rotation that is
/// none, and for 6D whose vectors are far from length 1 and right angles.
Eigen::MatrixXd ReadRotationRows(const NpzArchive& npz, const std::string& key,
                                 const std::vector<int64_t>& joints);

}  // namespace choreo
