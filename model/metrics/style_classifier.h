#pragma once

#include <Eigen/Core>

#include "model/metrics/critic.h"

namespace choreo {

/// Tells styles of dance apart by how joints move in a second: a ridge regression of the critic's
/// features on each style against the others. For measuring alone. Immutable; thread-safe.
class StyleClassifier {
 public:
  /// `windows.clips` numbers the style of each window, from 0 to `styles` - 1; each style weighs
  /// alike. Throws Error(kInvalidArgument) for a style without a window.
  StyleClassifier(const CriticWindows& windows, int styles);

  /// The style that a window is most like.
  int Classify(const Eigen::VectorXd& features) const;

 private:
  Eigen::VectorXd mean_, over_deviation_;
  Eigen::MatrixXd weights_;  // [styles, features]
};

}  // namespace choreo
