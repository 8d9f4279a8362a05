#include "model/flow/priors/energy_curve.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "model/core/grid.h"

namespace choreo {
namespace {

constexpr double kDoubt = 1e-3;  // share of the variance that keeps it invertible
// The history's level, a mean over its frames, counts as this many frames before the window.
constexpr int kHistoryAt = kHistoryFrames / 2;

}  // namespace

Eigen::MatrixXd EnergyCurve::Sample(const EnergyPrior::Levels& history,
                                    const Eigen::MatrixXd& normal) const {
  const Eigen::Index frames = normal.cols();
  const auto at = [&](Eigen::Index lag) {
    return correlation[std::min<Eigen::Index>(lag, kLags - 1)];
  };
  Eigen::VectorXd past(frames);
  for (Eigen::Index i = 0; i < frames; ++i) past[i] = at(i + kHistoryAt);
  Eigen::MatrixXd covariance = -past * past.transpose();
  for (Eigen::Index i = 0; i < frames; ++i) {
    for (Eigen::Index j = 0; j < frames; ++j) covariance(i, j) += at(std::abs(i - j));
  }
  // An estimate from few clips may not be a valid correlation: add doubt until it is. A doubt of a
  // hundred makes any correlation of at most 1 valid.
  for (double doubt = kDoubt;; doubt *= 10) {
    covariance.diagonal().array() += doubt;
    const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
    if (cholesky.info() != Eigen::Success) continue;
    const Eigen::MatrixXd own = normal * Eigen::MatrixXd(cholesky.matrixL()).transpose();
    return spread * own + history * past.transpose();
  }
}

std::vector<double> EnergyCurve::ToNumbers() const {
  std::vector<double> numbers(correlation.begin(), correlation.end());
  numbers.insert(numbers.end(), spread.data(), spread.data() + spread.size());
  return numbers;
}

EnergyCurve EnergyCurve::FromNumbers(std::span<const double> numbers) {
  EnergyCurve curve;
  std::copy_n(numbers.begin(), kLags, curve.correlation.data());
  std::copy_n(numbers.begin() + kLags, curve.spread.size(), curve.spread.data());
  return curve;
}

}  // namespace choreo
