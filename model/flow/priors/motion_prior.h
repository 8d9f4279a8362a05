#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "model/motion/controls/velocity_factors.h"
#include "model/motion/motion.h"

namespace choreo {

/// The variance of dancers' deviation from the prior's mean, as powers of known values. Measured in
/// training.
struct VariancePowers {
  static constexpr double kDefaultMinScale = 0.25;

  double surprise = 0;  ///< of FlowWindow::surprise
  /// The range in training, to which values are clipped.
  double least = 1e-3, most = 1e3;
  /// A body part with known energy has the variance exp(offset + level * EnergyLevel) *
  /// surprise^known_surprise.
  double offset = 0, known_surprise = 0, level = 0;
  double least_scale = kDefaultMinScale;        ///< the least factor of its spread
  std::vector<int> parts = {};                  ///< by dimension: its body part, or -1
  std::array<double, kBodyParts> medians = {};  ///< of the velocity factors, metres per frame
};

/// The energy of a body part relative to its median: the logarithm of the ratio of velocity
/// factors, flat below a millimetre a frame.
double EnergyLevel(double factor, double median);
/// The velocity factor with this EnergyLevel, at least 0.
double EnergyFactor(double level, double median);

/// Units of rotations as network inputs. Dimensions with a spread of at most `still` do not move in
/// recordings, but keys may move them. A unit near zero would make those inputs unbounded, so they
/// get the mean of the others. Leaves the first three, the root's position, unchanged.
Eigen::VectorXd FillUnusedSpread(Eigen::VectorXd spread, double still);

/// The pose that dancers return to when nothing is requested. Empty: unknown.
struct UsualPose {
  /// The pose in the canonical frame, at the stage's middle.
  Pose pose = {};
  Eigen::VectorXd variance = {};  ///< [dimensions], m² and rad², of the spread about it
  /// The variance of the angle between the root's heading and the audience, rad². 0: unknown, and
  /// dancers face anywhere.
  double facing = 0;

  /// The larger deviation of a pose's root from the usual height and tilt, in standard deviations.
  /// 0 if unknown.
  double Deviation(const Pose& other) const;
};

/// A prior for motion, given only its past and a key: the velocity of each degree of freedom is a
/// stationary Gaussian process. Its mean given history and key is the flow's starting point. The
/// flow's noise has its covariance, so it is as smooth as motion, at any length, with and without a
/// key.
///
/// Units: metres per frame for the root's position, radians per frame for rotations. Thread-safe.
class MotionPrior {
 public:
  static constexpr int kLags = 121;  ///< of a trained covariance: four seconds at 30 fps
  static constexpr int kPast = 3;    ///< velocities of the history that are known
  static constexpr int kTurn = 4;    ///< the dimension of the root's turn about the vertical
  /// Bound of white coordinates, in deviations from the mean: recordings beyond it are faulty.
  static constexpr double kMaxWhite = 5;
  /// Bound of the history's velocities, in their spreads. Keys and floor force faster ones, which
  /// do not last, and networks do not know them.
  static constexpr double kMaxSpeed = 8;

  /// The distribution of one degree of freedom's displacements f_1..f_w from the last history
  /// frame. Their mean weights the last velocities, latest first, by `past` [w, kPast], and the
  /// displacement to the key or, without one, to the usual pose by `key` [w]. `spread` [w, w] is
  /// the lower Cholesky factor of their covariance, so row i depends only on frames up to i.
  struct Bridge {
    Eigen::MatrixXd past;
    Eigen::VectorXd key;
    Eigen::MatrixXf spread;
    /// Variance of the known values: the last velocities, then the displacement.
    Eigen::VectorXd expected;
  };

  /// `covariance` [dimensions, lags]: the autocovariance of velocities by lag in frames. Throws
  /// Error(kInvalidArgument) if it is not a valid covariance.
  explicit MotionPrior(Eigen::MatrixXd covariance, VariancePowers powers = {},
                       UsualPose usual = {});

  int dimensions() const { return static_cast<int>(covariance_.rows()); }
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  const VariancePowers& powers() const { return powers_; }
  /// The factor of each frame's noise, [dimensions, frames], which keeps a lively dancer lively.
  /// `surprise`: the known displacements' squares over their expectation by the covariance (1 on
  /// average); `levels` [kBodyParts, frames]: EnergyLevel of each body part, NaN if unknown.
  Eigen::MatrixXd Scales(double surprise, const Eigen::MatrixXd& levels) const;
  /// The networks' unit of velocities, [dimensions]: their standard deviation.
  Eigen::VectorXd VelocitySpread() const;

  /// False for degrees of freedom that recordings lack, such as finger joints.
  bool Moves(int dimension) const;

  /// The bridges, by dimension, of a window of `frames` frames. The key is `to_key` >= `frames`
  /// frames after the history; 0: no key. Caches the latest.
  std::shared_ptr<const std::vector<Bridge>> Bridges(int frames, int to_key) const;
  /// The bridges of the root's position alone [3], without a key, on a stage with known middle.
  std::shared_ptr<const std::vector<Bridge>> StageBridges(int frames) const;
  /// The bridge of the root's turn about the vertical, without a key, on a stage with a known
  /// front: by the window's end it faces the audience with the usual pose's variance.
  std::shared_ptr<const Bridge> FacingBridge(int frames) const;
  const UsualPose& usual() const { return usual_; }

 private:
  using Made = std::shared_ptr<const std::vector<Bridge>>;
  Made Cached(std::pair<int, int> key, const std::function<std::vector<Bridge>()>& make) const;
  // `usual_variance`: about the usual pose, to which a window without a key returns; 0: none.
  // `doubt`: variance about the key.
  Bridge Make(int dimension, int frames, int to_key, double usual_variance, double doubt) const;
  double UsualVariance(int dimension) const {
    return usual_.variance.size() > 0 ? usual_.variance[dimension] : 0;
  }

  Eigen::MatrixXd covariance_;
  VariancePowers powers_;
  UsualPose usual_;
  // Sums of the covariance over lags from 1 on, by dimension, [lags].
  std::vector<Eigen::VectorXd> sums_;
  struct Cache;
  std::shared_ptr<Cache> cache_;
};

}  // namespace choreo
