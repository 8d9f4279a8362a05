#include "model/core/quantile.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace choreo {

double Percentile(std::vector<float> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(
      std::max(1.0, std::ceil(share * static_cast<double>(values.size()) - 1e-9)));
  std::ranges::nth_element(values, values.begin() + rank - 1);
  return values[static_cast<size_t>(rank - 1)];
}

double Quantile(std::vector<double> values, double q) {
  const auto index = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<size_t>(index)];
}

std::vector<double> SlowQuantile(const std::vector<double>& values, double q,
                                 double window_frames) {
  const auto count = static_cast<int>(values.size());
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * window_frames)));
  const auto around = [&](int frame) {
    return std::pair(std::max(0, frame - half), std::min(count, frame + half + 1));
  };
  std::vector<double> quantiles(values.size()), means(values.size());
  for (int frame = 0; frame < count; ++frame) {
    const auto [first, last] = around(frame);
    quantiles[static_cast<size_t>(frame)] =
        Quantile({values.begin() + first, values.begin() + last}, q);
  }
  for (int frame = 0; frame < count; ++frame) {
    const auto [first, last] = around(frame);
    means[static_cast<size_t>(frame)] =
        std::accumulate(quantiles.begin() + first, quantiles.begin() + last, 0.0) / (last - first);
  }
  return means;
}

}  // namespace choreo
