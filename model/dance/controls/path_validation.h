#pragma once

#include <string>

#include "model/motion/controls/control_request.h"
#include "model/motion/controls/path_curve.h"

namespace choreo {

/// Metres above the floor. A standing dancer's root is a metre lower, and nobody jumps that high.
inline constexpr double kMaxRootHeight = 2;

/// Throws Error(kInvalidArgument) below `field` for fewer than 2 points, frames that do not ascend
/// or are outside a dance, points that are not finite or are further than kMaxPosition from the
/// origin, different numbers of heights and points, or heights outside [0, kMaxRootHeight].
void CheckPath(const RootPath& path, const std::string& field);

}  // namespace choreo
