#include "model/core/numbers/quantile.h"

#include <cmath>
#include <numeric>

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
  // Applies `summary` to the values around each frame.
  const auto slide = [&](const std::vector<double>& of, const auto& summary) {
    std::vector<double> result;
    for (int frame = 0; frame < count; ++frame) {
      const int first = std::max(0, frame - half), last = std::min(count, frame + half + 1);
      result.push_back(summary(of.begin() + first, of.begin() + last));
    }
    return result;
  };
  const auto quantiles = slide(values, [&](auto first, auto last) {
    return Quantile({first, last}, q);
  });
  return slide(quantiles, [](auto first, auto last) {
    return std::accumulate(first, last, 0.0) / static_cast<double>(last - first);
  });
}

}  // namespace choreo
