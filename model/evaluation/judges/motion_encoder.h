#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/evaluation/windows.h"
#include "model/metrics/joint_track.h"

namespace choreo {

/// The motion encoder for FID, variability and diversity (paper F, 4.5.2 and 4.5.4): the principal
/// components of training motion, recomputed in each evaluation. A window of 30 frames, relative to
/// its middle frame's position and heading, becomes 32 numbers (fewer with fewer training windows)
/// with variance 1 over training; windows begin every 10 frames. Figures are comparable only if
/// version(), the hash of settings and training clips, is equal. Immutable; thread-safe.
class MotionEncoder {
 public:
  /// Fits the components to all windows of the sets. Throws Error(kInvalidArgument) for fewer than
  /// two windows.
  explicit MotionEncoder(const std::vector<ClipSet>& training);

  /// Codes of all windows of a dance, [codes, windows].
  Eigen::MatrixXd Encode(const Skeleton& skeleton, std::span<const Pose> poses) const;

  const std::string& version() const { return version_; }
  double explained() const { return explained_; }  ///< share of training motion's variance

 private:
  Eigen::VectorXd mean_;
  Eigen::MatrixXd projection_;  // [codes, inputs]
  std::string version_;
  double explained_ = 0;
};

/// The mean squared distance of corresponding windows over their common length, averaged over all
/// pairs of dances. `dances`: codes [codes, windows] each. 0 for fewer than two.
double MeanApart(const std::vector<Eigen::MatrixXd>& dances);

}  // namespace choreo
