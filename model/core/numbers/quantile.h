#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

/// Quantiles. Pure functions.
namespace choreo {

/// The value of rank ceil(share * count), counted from 1; `share` in [0, 1]. 0 for no values.
double Percentile(std::vector<float> values, double share);

/// The value of rank floor(q * (count - 1)), counted from 0. Needs at least one value.
double Quantile(std::vector<double> values, double q);

/// The running mean of a running quantile, which follows a signal's drift. Windows reach
/// window_frames / 2 to each side, less at the ends. One value per input value.
std::vector<double> SlowQuantile(const std::vector<double>& values, double q, double window_frames);

/// The median; of an even number of values the upper middle one. Needs at least one value.
template <typename Value>
Value Median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace choreo
