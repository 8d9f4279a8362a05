#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/fit/fit_terms.h"
#include "model/fit/landmarks.h"

namespace choreo {

/// A frame's start without a predecessor: joint by joint from the root, the rotation that best
/// turns the rest directions of the landmarks below onto the targets' (Kabsch), with a bent limb's
/// plane for the twist of hips and shoulders. Skeleton, marks and planes outlive it.
class FitStart {
 public:
  FitStart(const Skeleton& skeleton, const LandmarkSet& marks,
           const std::vector<HingePlane>& planes);

  void Start(const Eigen::Matrix3Xd& targets, Pose& pose) const;

  /// How far the trunk is turned from rest, all its joints together, radians.
  double TrunkTurn(const Pose& pose) const;

 private:
  bool InTrunk(int joint) const;  ///< between the root and both shoulders

  const Skeleton& skeleton_;
  const LandmarkSet& marks_;
  const std::vector<HingePlane>& planes_;
  Eigen::Matrix3Xd rest_joints_, rest_marks_;
};

}  // namespace choreo
