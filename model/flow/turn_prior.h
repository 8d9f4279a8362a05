#pragma once

#include <Eigen/Core>
#include <optional>

#include "model/flow/flow_window.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Which way round dancers turn to a key. Two turns end alike: the shorter one, and the rest of a
/// whole turn the other way. How likely the other is follows, by logistic regression, from how far
/// each goes and in what time, how the dancer turns and goes sideways already, how lively she is,
/// where the key stands, and how its chest is turned against the hips. Training measures it.
/// Thread-safe.
class TurnPrior {
 public:
  static constexpr int kInputs = 9;
  using Inputs = Eigen::Matrix<double, kInputs, 1>;

  /// All zero: unknown.
  Inputs weights = Inputs::Zero();

  bool known() const { return !weights.isZero(); }

  /// How the root turns from the last history pose to the key the shorter way, as its rotation
  /// vector in that pose's frame. `request` has a key.
  static Eigen::Vector3d ShorterTurn(const WindowRequest& request);
  /// What tells the other way from the shorter one; none of a request whose key does not ask how
  /// the root is turned, or asks for a turn about another axis than the vertical. Alike for a
  /// dancer and her mirror image.
  static std::optional<Inputs> Describe(const Skeleton& skeleton, const WindowRequest& request);
  double ChanceOfOther(const Inputs& inputs) const;
  /// WindowRequest::turning: the likelier way at temperature 0, at 1 each as often as dancers take
  /// it. `normal`: a standard normal number. None where nothing is known.
  std::optional<Eigen::Vector3d> Sample(const Skeleton& skeleton, const WindowRequest& request,
                                        double normal, double temperature) const;
};

}  // namespace choreo
