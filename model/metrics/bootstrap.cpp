#include "model/metrics/bootstrap.h"

#include <algorithm>
#include <vector>

#include "model/core/numbers/random.h"

namespace choreo {

std::optional<Interval> BootstrapRatio(std::span<const double> numerators,
                                       std::span<const double> denominators) {
  const size_t clips = numerators.size();
  if (clips < 2) return std::nullopt;
  constexpr uint64_t kSeed = 95;
  constexpr int kResamples = 2000;
  Random random(kSeed);
  std::vector<double> ratios;
  for (int i = 0; i < kResamples; ++i) {
    double above = 0, below = 0;
    for (size_t drawn = 0; drawn < clips; ++drawn) {
      const auto clip = static_cast<size_t>(random.Integer(0, static_cast<int64_t>(clips)));
      above += numerators[clip];
      below += denominators[clip];
    }
    if (below != 0) ratios.push_back(above / below);
  }
  if (ratios.empty()) return std::nullopt;
  std::ranges::sort(ratios);
  const auto at = [&](double share) {
    return ratios[static_cast<size_t>(share * static_cast<double>(ratios.size() - 1) + 0.5)];
  };
  return Interval{at(0.025), at(0.975)};
}

}  // namespace choreo
