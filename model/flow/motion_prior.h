#pragma once

#include <Eigen/Core>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace choreo {

/// How poses move when nothing but their past and a key is known: the velocity of every degree of
/// freedom is a stationary Gaussian process. Its mean through history and key is the line that the
/// flow departs from; its covariance is the flow's noise. Noise so made is as smooth as motion is,
/// at any length, with a key and without.
///
/// Units: metres a frame for the root's position, radians a frame for rotations. Thread-safe.
class MotionPrior {
 public:
  static constexpr int kLags = 121;  ///< of a trained covariance: four seconds at 30 fps
  static constexpr int kPast = 3;    ///< velocities of the history that are known
  /// Deviations from the mean that white coordinates go: what recordings have beyond are faults.
  static constexpr double kMostWhite = 5;

  /// What is known of the displacements f_1..f_w from the last history frame of one degree of
  /// freedom. `past` [w, kPast] and `key` [w] weigh the last velocities (latest first) and the
  /// key's displacement in their mean; `spread` [w, w] is the lower Cholesky factor of their
  /// covariance, so that row i depends on frames up to i alone.
  struct Bridge {
    Eigen::MatrixXd past;
    Eigen::VectorXd key;
    Eigen::MatrixXd spread;
    /// Inverse covariance of what is known: the last velocities, then the key's displacement.
    Eigen::MatrixXd precision;
  };

  /// `covariance` [dimensions, lags]: of a velocity with itself so many frames later.
  /// `liveliness`: see Scale. Throws Error(kInvalidArgument) where it is no covariance.
  explicit MotionPrior(Eigen::MatrixXd covariance, double liveliness = 0);

  int dimensions() const { return static_cast<int>(covariance_.rows()); }
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  /// Who is known to be lively goes on so: the factor of all spreads where what is known of a
  /// window has `surprise` times the squares that the covariance expects (1 on average). A power of
  /// that, which training measured.
  double Scale(double surprise) const;
  /// Standard deviation of a velocity, [dimensions].
  Eigen::VectorXd VelocitySpread() const { return covariance_.col(0).cwiseSqrt(); }

  /// False for what recordings lack, as the joints of hands.
  bool Moves(int dimension) const;

  /// By dimension: a window of `frames` frames whose key stands `to_key` frames behind the history
  /// (at least `frames`); 0: there is no key. The last few that were asked for are kept.
  std::shared_ptr<const std::vector<Bridge>> Bridges(int frames, int to_key) const;

 private:
  Bridge Make(int dimension, int frames, int to_key) const;

  Eigen::MatrixXd covariance_;
  double liveliness_;
  // By dimension, [lags]: sums of the covariance over lags from 1 on.
  std::vector<Eigen::VectorXd> sums_;
  struct Cache;
  std::shared_ptr<Cache> cache_;
};

}  // namespace choreo
