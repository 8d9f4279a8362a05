#pragma once

namespace choreo {

/// From 0 at u = 0 to 1 at u = 1, level at both.
inline double SmoothStep(double u) { return u * u * (3 - 2 * u); }

}  // namespace choreo
