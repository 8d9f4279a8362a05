#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/evaluation/windows.h"
#include "model/metrics/joint_track.h"

namespace choreo {

/// The motion encoder of FID, variability and diversity (paper F, 4.5.2 and 4.5.4): the principal
/// components of training motion, learnt at each evaluation. A window of 30 frames, seen from its
/// middle frame's place and heading, becomes 32 numbers, or fewer where there are fewer training
/// windows, of variance 1 over those; the next begins 10 frames later. Figures of different
/// version()s, the hash of settings and training clips, don't compare. Immutable; thread-safe.
class MotionEncoder {
 public:
  /// Learns from every window of the sets, the same for all clips. Throws Error(kInvalidArgument)
  /// for fewer than two windows.
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

/// Mean over all pairs of dances of the mean squared distance of their corresponding windows, over
/// their common length. `dances`: codes [codes, windows] each. 0 for fewer than two.
double MeanApart(const std::vector<Eigen::MatrixXd>& dances);

}  // namespace choreo
