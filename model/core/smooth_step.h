#pragma once

#include <cmath>

namespace choreo {

/// Rises from 0 at u = 0 to 1 at u = 1, with zero slope at both ends. `Number`: float, double or a
/// vector of them.
template <class Number>
Number SmoothStep(Number u) {
  return u * u * (3 - 2 * u);
}

/// The seconds of a smooth step of `size` whose acceleration is at most `acceleration`, 6 size /
/// t², per second squared.
inline double StepSeconds(double size, double acceleration) {
  return std::sqrt(6 * size / acceleration);
}

}  // namespace choreo
