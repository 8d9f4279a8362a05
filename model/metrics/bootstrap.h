#pragma once

#include <optional>
#include <span>

namespace choreo {

/// Where a figure would lie with other clips of the same kind.
struct Interval {
  double low = 0, high = 0;
};

/// The 95 % percentile bootstrap interval (Efron 1979) of sum(numerators) / sum(denominators): one
/// entry a clip, clips drawn with replacement, since windows of one clip are not independent. A
/// mean is the ratio of sums to counts. Both are of one length. Counter RNG with a fixed seed: the
/// same figures, the same interval. None for fewer than two clips.
std::optional<Interval> BootstrapRatio(std::span<const double> numerators,
                                       std::span<const double> denominators);

}  // namespace choreo
