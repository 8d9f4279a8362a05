#pragma once

namespace choreo {

/// Rises from 0 at u = 0 to 1 at u = 1, with zero slope at both ends.
inline double SmoothStep(double u) { return u * u * (3 - 2 * u); }

}  // namespace choreo
