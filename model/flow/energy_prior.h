#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "model/core/grid.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

/// The energy of a window where no control gives it: the EnergyLevel of each body part is Gaussian,
/// given what is known of the window. Without this prior every dance has the mean energy. Measured
/// in training. Thread-safe.
class EnergyPrior {
  static constexpr double kEverything = 1e3;

 public:
  using Levels = Eigen::Matrix<double, kBodyParts, 1>;

  /// What is known of a window.
  struct Known {
    bool key = false;
    double surprise = 1;              ///< FlowWindow::surprise
    Levels history = Levels::Zero();  ///< of the poses before it; zero for a held pose
    /// Levels of the straight way to the key, the least that a dancer can do: of joints relative to
    /// the root, with the root's own as the trunk's; and of all joints in the world. None if the
    /// key leaves them open.
    std::optional<Levels> way = {}, way_in_world = {};
    int frames = kTypicalFrames;
    int style = -1;  ///< requested style, or -1
  };
  /// One, the logarithm of the surprise, the history's levels and those of both ways; then the same
  /// times the logarithm of the window's length over two seconds.
  static constexpr int kInputs = 2 * (2 + 3 * kBodyParts);
  using Inputs = Eigen::Matrix<double, kInputs, 1>;
  Inputs Describe(const Known& known) const;
  /// The range of each input in training; inputs, and levels (with the history's range), are
  /// clipped to it. Initially unbounded.
  Inputs least = Inputs::Constant(-kEverything), most = Inputs::Constant(kEverything);
  /// Replacements for ways that a key leaves open: training's means.
  Levels usual_way = Levels::Zero(), usual_way_in_world = Levels::Zero();

  static constexpr int kHistoryInput = 2;  ///< index of the history's levels
  using Weights = Eigen::Matrix<double, kBodyParts, kInputs>;

  /// Weights of the inputs in the mean, with a key and without. All zero: the median energy for
  /// all.
  Weights keyed = Weights::Zero(), free = Weights::Zero();
  /// The lower Cholesky factor of the remaining covariance with a key. Used without one, too:
  /// differences between dancers are no reason for one to change at each window.
  Eigen::Matrix<double, kBodyParts, kBodyParts> spread = decltype(spread)::Zero();
  Eigen::Matrix<double, kBodyParts, Eigen::Dynamic> styles;  ///< the levels that each style adds

  explicit EnergyPrior(size_t style_count = 0) { styles.setZero(kBodyParts, style_count); }

  /// `normal`: standard normal numbers, or zero for the mean.
  Levels Sample(const Known& known, const Levels& normal) const;

  /// Levels, one per column, clipped to their range in training.
  Eigen::MatrixXd Bound(const Eigen::MatrixXd& levels) const;
  /// The highest levels of training.
  Levels MostEnergy() const { return most.segment<kBodyParts>(kHistoryInput); }
  /// The remaining variance with a key, by part.
  Levels Variance() const { return spread.rowwise().squaredNorm(); }

  /// All numbers in a row, as stored in checkpoints.
  std::vector<double> ToNumbers() const;
  /// Restores them, for a prior with equally many styles.
  void SetNumbers(std::span<const double> numbers);
};

}  // namespace choreo
