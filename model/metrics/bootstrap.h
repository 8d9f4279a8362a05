#pragma once

#include <optional>
#include <span>

namespace choreo {

/// A confidence interval: the range of a figure over other clips of the same kind.
struct Interval {
  double low = 0, high = 0;
};

/// The 95 % percentile bootstrap interval (Efron 1979) of sum(numerators) / sum(denominators), each
/// with one entry per clip. Draws clips with replacement, because windows of one clip are not
/// independent. For a mean, pass sums and counts. Deterministic: uses a counter-based generator
/// with a fixed seed. None for fewer than two clips.
std::optional<Interval> BootstrapRatio(std::span<const double> numerators,
                                       std::span<const double> denominators);

}  // namespace choreo
