#pragma once

#include <cmath>

namespace choreo {

/// Rises from 0 at u = 0 to 1 at u = 1, with zero slope at both ends. `Number`: float, double or a
/// vector of them.
template <class Number>
Number SmoothStep(Number u) {
  return u * u * (3 - 2 * u);
}

/// The seconds that a smooth step of `size` takes if it accelerates by at most `acceleration`, per
/// second squared. In t seconds it accelerates by at most 6 size / t².
inline double StepSeconds(double size, double acceleration) {
  return std::sqrt(6 * size / acceleration);
}

}  // namespace choreo
