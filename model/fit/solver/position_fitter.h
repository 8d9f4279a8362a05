#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "model/core/grid.h"
#include "model/fit/solver/fit_problem.h"

namespace choreo {

/// Fits frame after frame, causally: a result depends only on its frame and earlier ones. Not
/// thread-safe; use one per stream.
class PositionFitter {
 public:
  PositionFitter(const Skeleton& skeleton, const SourceMapping& mapping,
                 const FitOptions& options = {}, double fps = kModelFps);

  /// Fits the next pose to landmark targets [3, landmarks], metres, on the exponential-map branch
  /// nearest to the frame before. Rotations that the targets leave open, such as a straight arm's
  /// twist, change little from the frame before and stay close to `after`'s, if given.
  const Pose& Next(const Eigen::Matrix3Xd& targets, const Pose* after = nullptr);

  /// Continues as if `previous` had been the frame before.
  void Reset(const Pose& previous) { pose_ = previous; }

 private:
  void Recover(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours, double distance);

  std::unique_ptr<FitProblem> problem_;
  FitOptions options_;
  std::optional<Pose> pose_;  ///< of the last frame
};

}  // namespace choreo
