#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/flow/priors/energy_prior.h"

namespace choreo {

/// A model of a dancer's energy over time: the EnergyLevel of a body part over frames is a
/// stationary Gaussian process. Without it energy would be constant, and hands would never rest.
/// Measured in training. Thread-safe.
struct EnergyCurve {
  static constexpr int kLags = 97;
  static constexpr int kNumbers = kLags + kBodyParts * kBodyParts;

  /// Autocorrelation of a level by lag in frames, [kLags], 1 first, in [-1, 1]. All zero: levels
  /// are constant.
  Eigen::VectorXd correlation = Eigen::VectorXd::Zero(kLags);
  /// The lower Cholesky factor of the parts' covariance in one frame.
  Eigen::Matrix<double, kBodyParts, kBodyParts> spread = decltype(spread)::Zero();

  bool known() const { return correlation[0] > 0; }
  /// Whether the process can be sampled.
  bool IsValid() const {
    return spread.allFinite() && correlation.allFinite() && correlation.cwiseAbs().maxCoeff() <= 1;
  }
  /// Samples levels minus their mean, [kBodyParts, frames]. `history`: the level, minus the mean,
  /// of the poses before. `normal` [kBodyParts, frames]: standard normal numbers.
  Eigen::MatrixXd Sample(const EnergyPrior::Levels& history, const Eigen::MatrixXd& normal) const;

  /// All numbers in one row, as stored in checkpoints.
  std::vector<double> ToNumbers() const;
  static EnergyCurve FromNumbers(std::span<const double> numbers);
};

}  // namespace choreo
