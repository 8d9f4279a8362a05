#pragma once

#include <cmath>
#include <cstdint>

namespace choreo {

/// The Gaussian-weighted mean of value(i), first <= i <= last. The Gaussian's centre is i =
/// `centre`, its standard deviation `sigma` > 0. `zero` initialises the sum.
template <typename Value, typename ValueAt>
Value GaussianMean(int64_t first, int64_t last, int64_t centre, double sigma, const Value& zero,
                   const ValueAt& value) {
  Value sum = zero;
  double weights = 0;
  for (int64_t i = first; i <= last; ++i) {
    const double away = static_cast<double>(i - centre) / sigma;
    const double weight = std::exp(-0.5 * away * away);
    sum += weight * value(i);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace choreo
