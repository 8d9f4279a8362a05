#pragma once

#include <Eigen/Core>
#include <optional>

#include "model/flow/window/flow_window.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Chooses the direction in which dancers turn to a key. Two turns end alike: the shorter one, and
/// the rest of a whole turn in the other direction. Logistic regression gives the longer turn's
/// probability from both turns' angles and speeds, the dancer's present turn, sideways motion and
/// energy, the key's position, and the turn of its chest against the hips. Measured in training.
/// Thread-safe.
class TurnPrior {
 public:
  static constexpr int kInputs = 9;
  using Inputs = Eigen::Matrix<double, kInputs, 1>;

  /// All zero: unknown.
  Inputs weights = Inputs::Zero();

  bool known() const { return !weights.isZero(); }

  /// The shorter turn of the root from the last history pose to the key, as a rotation vector in
  /// that pose's frame. `request` has a key.
  static Eigen::Vector3d ShorterTurn(const WindowRequest& request);
  /// The inputs that distinguish the two directions. None if the key leaves the root's rotation
  /// open, or turns it about another axis than the vertical. A dancer and the mirror image have
  /// equal inputs.
  static std::optional<Inputs> Describe(const Skeleton& skeleton, const WindowRequest& request);
  double ChanceOfOther(const Inputs& inputs) const;
  /// Returns WindowRequest::turn_to_key: the likelier direction at temperature 0; at 1, each as
  /// often as dancers choose it. `normal`: a standard normal number. None if unknown.
  std::optional<Eigen::Vector3d> Sample(const Skeleton& skeleton, const WindowRequest& request,
                                        double normal, double temperature) const;
};

}  // namespace choreo
