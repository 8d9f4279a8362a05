#pragma once

#include <torch/types.h>

#include <vector>

/// What training losses are made of. Units and reductions are part of a loss's definition: metres
/// summed beside nats would vanish.
namespace choreo {

/// Losses of lengths are in decimetres, in which those of paper F and C are about 1.
inline constexpr double kDecimetresPerMetre = 10;

/// One term of a loss.
struct LossTerm {
  const char* name;     ///< with its unit, as in curves.csv
  double weight;        ///< in the sum (paper F, Eq. 8)
  torch::Tensor value;  ///< scalar, unweighted
};
using LossTerms = std::vector<LossTerm>;

}  // namespace choreo
