#pragma once

namespace choreo {

/// Rises from 0 at u = 0 to 1 at u = 1, with zero slope at both ends. `Number`: float, double or a
/// vector of them.
template <class Number>
Number SmoothStep(Number u) {
  return u * u * (3 - 2 * u);
}

}  // namespace choreo
