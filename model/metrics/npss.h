#pragma once

#include <Eigen/Core>

namespace choreo {

/// Normalized power spectrum similarity (Gopalakrishnan et al. 2019, Section 4.1; used for
/// transitions by Harvey et al. 2020): how far apart the shares of power at each frequency are.
/// 0 is equal; no unit, lower is better.
///
/// For each window and feature: the power |X_k|^2 of the discrete Fourier transform over time,
/// normalised to sum 1; the earth mover's distance of the two is the sum of the absolute
/// differences of their cumulative sums. The result is the mean over windows and features, weighted
/// by the real motion's power. Features of a transition are its global quaternions
/// (GlobalQuaternions). Not thread-safe.
class NpssMeter {
 public:
  /// Both [features, frames]. A feature without power in either motion does not count.
  void Add(const Eigen::MatrixXd& danced, const Eigen::MatrixXd& real);
  /// 0 before the first window.
  double value() const { return weights_ > 0 ? sum_ / weights_ : 0; }

  /// What has been added, so that windows can be gathered by clip: value() is sum() / weights().
  double sum() const { return sum_; }
  double weights() const { return weights_; }

 private:
  double sum_ = 0, weights_ = 0;
};

}  // namespace choreo
