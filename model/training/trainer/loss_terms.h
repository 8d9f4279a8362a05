#pragma once

#include <torch/types.h>

#include <vector>

/// Terms of training losses. Units and reductions are part of a loss's definition, because a sum of
/// metres would vanish beside nats.
namespace choreo {

/// Losses of lengths are in decimetres: papers F's and C's losses are then near 1.
inline constexpr double kDecimetresPerMetre = 10;

/// One term of a loss.
struct LossTerm {
  const char* name;     ///< with its unit, as in curves.csv
  double weight;        ///< weight in the sum (paper F, Eq. 8)
  torch::Tensor value;  ///< scalar, unweighted
};
using LossTerms = std::vector<LossTerm>;

}  // namespace choreo
