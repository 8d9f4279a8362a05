#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

/// How far dancers stray from the prior's mean, by what is known of them: powers that training
/// measured of the variance.
struct VariancePowers {
  static constexpr double kUsualLeastScale = 0.25;

  double surprise = 0;  ///< of FlowWindow::surprise
  /// What of that training saw: who moves less or more counts as so much.
  double least = 1e-3, most = 1e3;
  /// Of a body part whose energy is known: times e to `offset`, the surprise to a power, and e to
  /// `level` times its EnergyLevel.
  double offset = 0, known_surprise = 0, level = 0;
  double least_scale = kUsualLeastScale;  ///< the least that its spread is so
  std::vector<int> parts = {};            ///< by dimension: the body part that it belongs to, or -1
  std::array<double, kBodyParts> medians = {};  ///< of their velocity factors, metres a frame
};

/// How much livelier a body part is than its median: the logarithm of its velocity factor's share,
/// flat below a millimetre a frame.
double EnergyLevel(double factor, double median);
/// The factor of that level, at least 0.
double EnergyFactor(double level, double median);

/// Units of rotations that a network is told of. What spreads by no more than `still` is not in the
/// recordings; keys may move it all the same, and in units of nothing that would be beyond all
/// bounds: it has the mean of the others. The first three, of the root's position, stay.
Eigen::VectorXd AsTheOthers(Eigen::VectorXd spread, double still);

/// What dancers come back to where nothing is asked of them, as measured. Empty: unknown.
struct UsualPose {
  /// In the canonical frame, over the stage's middle.
  Pose pose = {};
  Eigen::VectorXd variance = {};  ///< [dimensions], m² and rad², of where they are about it
};

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
  /// displacement of the key or, without one, of the usual pose, in their mean; `spread` [w, w] is
  /// the lower Cholesky factor of their covariance, so that row i depends on frames up to i alone.
  struct Bridge {
    Eigen::MatrixXd past;
    Eigen::VectorXd key;
    Eigen::MatrixXf spread;
    /// Variance of what is known: the last velocities, then that displacement.
    Eigen::VectorXd expected;
  };

  /// `covariance` [dimensions, lags]: of a velocity with itself so many frames later.
  /// Throws Error(kInvalidArgument) where it is no covariance.
  explicit MotionPrior(Eigen::MatrixXd covariance, VariancePowers powers = {},
                       UsualPose usual = {});

  int dimensions() const { return static_cast<int>(covariance_.rows()); }
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  const VariancePowers& powers() const { return powers_; }
  /// Who is known to be lively goes on so: the factor of each frame's noise, [dimensions, frames].
  /// What is known of the window has `surprise` times the squares that the covariance expects (1 on
  /// average); `levels` [kBodyParts, frames]: EnergyLevel of each body part, NaN where it is
  /// unknown.
  Eigen::MatrixXd Scales(double surprise, const Eigen::MatrixXd& levels) const;
  /// The unit that networks have velocities in, [dimensions]: their standard deviation.
  Eigen::VectorXd VelocitySpread() const;

  /// False for what recordings lack, as the joints of hands.
  bool Moves(int dimension) const;

  /// By dimension: a window of `frames` frames whose key stands `to_key` frames behind the history
  /// (at least `frames`); 0: there is no key. The last few that were asked for are kept.
  std::shared_ptr<const std::vector<Bridge>> Bridges(int frames, int to_key) const;
  /// Without a key, of the root's position alone [3], on a stage whose middle is known.
  std::shared_ptr<const std::vector<Bridge>> StageBridges(int frames) const;
  const UsualPose& usual() const { return usual_; }

 private:
  using Made = std::shared_ptr<const std::vector<Bridge>>;
  Made Cached(std::pair<int, int> key, const std::function<std::vector<Bridge>()>& make) const;
  // `usual_variance`: about the usual pose, which a window without a key comes back to; 0: none.
  Bridge Make(int dimension, int frames, int to_key, double usual_variance) const;
  double UsualVariance(int dimension) const {
    return usual_.variance.size() > 0 ? usual_.variance[dimension] : 0;
  }

  Eigen::MatrixXd covariance_;
  VariancePowers powers_;
  UsualPose usual_;
  // By dimension, [lags]: sums of the covariance over lags from 1 on.
  std::vector<Eigen::VectorXd> sums_;
  struct Cache;
  std::shared_ptr<Cache> cache_;
};

}  // namespace choreo
