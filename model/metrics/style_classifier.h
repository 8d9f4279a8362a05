#pragma once

#include <Eigen/Core>

#include "model/metrics/critic.h"

namespace choreo {

/// Classifies dance styles by the joints' movement within a second: one-against-all ridge
/// regression on the critic's features. Only for measuring. Immutable; thread-safe.
class StyleClassifier {
 public:
  /// `windows.clips` holds the style of each window, from 0 to `styles` - 1; styles have equal
  /// weight. Throws Error(kInvalidArgument) for a style without a window.
  StyleClassifier(const CriticWindows& windows, int styles);

  /// The most likely style of a window.
  int Classify(const Eigen::VectorXd& features) const;

 private:
  Eigen::VectorXd mean_, over_deviation_;
  Eigen::MatrixXd weights_;  // [styles, features]
};

}  // namespace choreo
