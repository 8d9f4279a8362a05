#pragma once

#include <optional>
#include <span>

namespace choreo {

/// The range of a figure over other clips of the same kind.
struct Interval {
  double low = 0, high = 0;
};

/// The 95 % percentile bootstrap interval (Efron 1979) of sum(numerators) / sum(denominators), one
/// entry per clip. Draws clips with replacement, since windows of one clip are not independent. A
/// mean is the ratio of sums to counts. Both have equal length. Deterministic: counter RNG with a
/// fixed seed. None for fewer than two clips.
std::optional<Interval> BootstrapRatio(std::span<const double> numerators,
                                       std::span<const double> denominators);

}  // namespace choreo
