#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/flow/energy_prior.h"

namespace choreo {

/// How a dancer's energy rises and falls: the EnergyLevel of a body part over frames is a
/// stationary Gaussian process. Without it energy would be constant, and hands never rest. Measured
/// in training. Thread-safe.
struct EnergyCurve {
  static constexpr int kLags = 97;
  static constexpr int kNumbers = kLags + kBodyParts * kBodyParts;

  /// Correlation of a level with itself that many frames later, [kLags], 1 first, in [-1, 1]. All
  /// zero: levels are constant.
  Eigen::VectorXd correlation = Eigen::VectorXd::Zero(kLags);
  /// The lower Cholesky factor of the parts' covariance in one frame.
  Eigen::Matrix<double, kBodyParts, kBodyParts> spread = decltype(spread)::Zero();

  bool known() const { return correlation[0] > 0; }
  /// Whether it can be sampled.
  bool IsValid() const {
    return spread.allFinite() && correlation.allFinite() && correlation.cwiseAbs().maxCoeff() <= 1;
  }
  /// Samples levels minus their mean, [kBodyParts, frames]; `history`: the same for the poses
  /// before. `normal` [kBodyParts, frames]: standard normal numbers.
  Eigen::MatrixXd Sample(const EnergyPrior::Levels& history, const Eigen::MatrixXd& normal) const;

  /// All numbers in a row, as stored in checkpoints.
  std::vector<double> ToNumbers() const;
  static EnergyCurve FromNumbers(std::span<const double> numbers);
};

}  // namespace choreo
