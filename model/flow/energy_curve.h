#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/flow/energy_prior.h"

namespace choreo {

/// How a dancer lingers and bursts: the EnergyLevel of a body part, frame by frame, is a stationary
/// Gaussian process. Noise of one energy all along never rests, so hands did not. Training measures
/// it. Thread-safe.
struct EnergyCurve {
  static constexpr int kLags = 97;
  static constexpr int kNumbers = kLags + kBodyParts * kBodyParts;

  /// Of a level with itself so many frames later, [kLags], 1 first, in [-1, 1]. All zero: levels
  /// are constant.
  Eigen::VectorXd correlation = Eigen::VectorXd::Zero(kLags);
  /// The lower Cholesky factor of the covariance of the parts in one frame.
  Eigen::Matrix<double, kBodyParts, kBodyParts> spread = decltype(spread)::Zero();

  bool known() const { return correlation[0] > 0; }
  /// Whether it may be sampled.
  bool IsValid() const {
    return spread.allFinite() && correlation.allFinite() && correlation.cwiseAbs().maxCoeff() <= 1;
  }
  /// Levels less their mean, [kBodyParts, frames]; `history`: of the poses before, less the same.
  /// `normal` [kBodyParts, frames]: standard normal numbers.
  Eigen::MatrixXd Sample(const EnergyPrior::Levels& history, const Eigen::MatrixXd& normal) const;

  /// All numbers in a row, as checkpoints hold them.
  std::vector<double> ToNumbers() const;
  static EnergyCurve FromNumbers(std::span<const double> numbers);
};

}  // namespace choreo
