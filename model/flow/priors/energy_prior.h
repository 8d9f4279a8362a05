#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "model/core/grid.h"
#include "model/motion/controls/velocity_factors.h"

namespace choreo {

/// A prior for a window's energy where no control sets it: given what is known of the window, the
/// body parts' levels (EnergyLevel) are Gaussian. Without this prior every dance would have the
/// mean energy. Measured in training. Thread-safe.
class EnergyPrior {
  static constexpr double kEverything = 1e3;

 public:
  using Levels = Eigen::Matrix<double, kBodyParts, 1>;

  /// What is known of a window.
  struct Known {
    bool key = false;
    double surprise = 1;              ///< FlowWindow::surprise
    Levels history = Levels::Zero();  ///< of the poses before it; zero for a held pose
    /// Levels of the direct motion to the key, the least possible. `way`: of joints relative to the
    /// root, with the root's own level as the trunk's. `way_in_world`: of all joints in the world.
    /// None if the key leaves them open.
    std::optional<Levels> way = {}, way_in_world = {};
    int frames = kTypicalFrames;
    int style = -1;  ///< requested style, or -1
  };
  /// The number of inputs: one, the logarithm of the surprise, the levels of the history and of
  /// both direct motions; then all of these times the logarithm of the window's length over two
  /// seconds.
  static constexpr int kInputs = 2 * (2 + 3 * kBodyParts);
  using Inputs = Eigen::Matrix<double, kInputs, 1>;
  Inputs Describe(const Known& known) const;
  /// The range of each input in training, to which inputs are clipped; levels are clipped to the
  /// history's. Initially unbounded.
  Inputs least = Inputs::Constant(-kEverything), most = Inputs::Constant(kEverything);
  /// Replacements for direct motions that a key leaves open: the means in training.
  Levels usual_way = Levels::Zero(), usual_way_in_world = Levels::Zero();

  static constexpr int kHistoryInput = 2;  ///< index of the history's levels
  using Weights = Eigen::Matrix<double, kBodyParts, kInputs>;

  /// The inputs' weights in the mean, with a key and without. All zero: the median energy.
  Weights keyed = Weights::Zero(), free = Weights::Zero();
  /// The lower Cholesky factor of the residual covariance with a key. Used without a key, too,
  /// because differences between dancers must not make one dancer change at each window.
  Eigen::Matrix<double, kBodyParts, kBodyParts> spread = decltype(spread)::Zero();
  Eigen::Matrix<double, kBodyParts, Eigen::Dynamic> styles;  ///< the levels added by each style

  explicit EnergyPrior(size_t style_count = 0) { styles.setZero(kBodyParts, style_count); }

  /// `normal`: standard normal numbers, or zero for the mean.
  Levels Sample(const Known& known, const Levels& normal) const;

  /// Levels, one per column, clipped to their range in training.
  Eigen::MatrixXd Bound(const Eigen::MatrixXd& levels) const;
  /// The highest levels of training.
  Levels MostEnergy() const { return most.segment<kBodyParts>(kHistoryInput); }
  /// The residual variance with a key, by part.
  Levels Variance() const { return spread.rowwise().squaredNorm(); }

  /// All numbers in a row, as stored in checkpoints.
  std::vector<double> ToNumbers() const;
  /// Restores these numbers, for a prior with the same number of styles.
  void SetNumbers(std::span<const double> numbers);
};

}  // namespace choreo
