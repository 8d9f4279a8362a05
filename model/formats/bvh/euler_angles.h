#pragma once

#include <Eigen/Core>
#include <span>

namespace choreo {

/// Angles z, x, y (radians, [3, frames]) with R = Rz Rx Ry, for a joint's rotations in time. Every
/// rotation has two such triples, plus whole turns. Over all frames, the curve takes triples near
/// their neighbours and, with less weight, near zero. So it does not wind up where the middle angle
/// passes a quarter turn, and a changed frame changes only the curve around it. Pure.
Eigen::Matrix3Xd EulerAnglesZxy(std::span<const Eigen::Matrix3d> rotations);

}  // namespace choreo
