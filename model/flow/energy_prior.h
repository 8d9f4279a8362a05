#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "model/core/grid.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

/// How lively dancers go on where nobody says it: the EnergyLevel of each body part in a window is
/// Gaussian, given what is known of the window. Without it a dance has one liveliness, the mean
/// one. Training measures it. Thread-safe.
class EnergyPrior {
  static constexpr double kEverything = 1e3;

 public:
  using Levels = Eigen::Matrix<double, kBodyParts, 1>;

  /// What is known of a window.
  struct Known {
    bool key = false;
    double surprise = 1;              ///< FlowWindow::surprise
    Levels history = Levels::Zero();  ///< of the poses before it; of a held pose zero
    /// Of the straight way to the key, the least that a dancer can do: of the joints as the root
    /// sees them, the root's own as the trunk's; and of all joints in the world. None: the key
    /// leaves it open.
    std::optional<Levels> way = {}, way_in_world = {};
    int frames = kUsualFrames;
    int style = -1;  ///< that is asked for, or -1
  };
  /// One, the logarithm of the surprise, the history's levels and those of both ways; then the same
  /// times how much longer than two seconds the window is, a logarithm.
  static constexpr int kInputs = 2 * (2 + 3 * kBodyParts);
  using Inputs = Eigen::Matrix<double, kInputs, 1>;
  Inputs Describe(const Known& known) const;
  /// What of that training saw: what is less or more counts as so much, and so do levels, whose
  /// range is that of the history's. At first that is everything.
  Inputs least = Inputs::Constant(-kEverything), most = Inputs::Constant(kEverything);
  /// The ways that stand for those that a key leaves open: training's mean.
  Levels usual_way = Levels::Zero(), usual_way_in_world = Levels::Zero();

  static constexpr int kHistoryInput = 2;  ///< where its levels stand
  using Weights = Eigen::Matrix<double, kBodyParts, kInputs>;

  /// Of the inputs in the mean, with a key and without. All zero: everybody is as lively as the
  /// median.
  Weights keyed = Weights::Zero(), free = Weights::Zero();
  /// The lower Cholesky factor of what is left where there is a key. It holds without one, too:
  /// that dancers differ from each other is no reason for one to change at each window.
  Eigen::Matrix<double, kBodyParts, kBodyParts> spread = decltype(spread)::Zero();
  Eigen::Matrix<double, kBodyParts, Eigen::Dynamic> styles;  ///< how much livelier each style is

  explicit EnergyPrior(size_t style_count = 0) { styles.setZero(kBodyParts, style_count); }

  /// `normal`: standard normal numbers; zero for the mean.
  Levels Sample(const Known& known, const Levels& normal) const;

  /// Levels, a column each, within what training saw.
  Eigen::MatrixXd Bound(const Eigen::MatrixXd& levels) const;
  /// What is left where there is a key, by part.
  Levels Variance() const { return spread.rowwise().squaredNorm(); }

  /// All numbers in a row, as checkpoints hold them.
  std::vector<double> ToNumbers() const;
  /// Of a prior that has as many styles.
  void SetNumbers(std::span<const double> numbers);
};

}  // namespace choreo
