#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

/// Values of a certain rank. Pure functions.
namespace choreo {

/// The value below which `share` (0 to 1) of the values lie: the one of rank
/// ceil(share * count), counted from 1. 0 for none.
double Percentile(std::vector<float> values, double share);

/// The value of rank floor(q * (count - 1)), counted from 0; at least one value.
double Quantile(std::vector<double> values, double q);

/// A running quantile, and its running mean: what a signal does slowly. As many frames to each side
/// as half of `window_frames`, where there are so many.
std::vector<double> SlowQuantile(const std::vector<double>& values, double q, double window_frames);

/// The upper one of two in the middle; at least one value.
template <typename Value>
Value Median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace choreo
