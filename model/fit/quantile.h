#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace choreo {

/// The value below which a share q of these lies; at least one value.
inline double Quantile(std::vector<double> values, double q) {
  const auto index = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<size_t>(index)];
}

/// The upper one of two in the middle; at least one value.
inline double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The frames around one, as many to each side as there are, [first, last).
inline std::pair<int, int> WindowAround(int frame, int half, int count) {
  return {std::max(0, frame - half), std::min(count, frame + half + 1)};
}

}  // namespace choreo
