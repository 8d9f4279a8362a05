#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/motion/skeleton.h"

namespace choreo {

/// An arm, as joint indices.
struct Arm {
  int shoulder = -1, elbow = -1, wrist = -1;
  int hand = -1;  ///< -1 if the skeleton has none
};

/// The left and the right arm; none if the skeleton lacks shoulder, elbow or wrist of one.
std::vector<Arm> ArmsOf(const Skeleton& skeleton);

/// The line through the trunk's joints, from between the shoulders down to the root: how far arms
/// are from the middle of the body. Immutable; thread-safe.
class TrunkLine {
 public:
  /// The skeleton must have ArmsOf.
  explicit TrunkLine(const Skeleton& skeleton);

  /// The trunk's joints, from the one below the shoulders down to the root.
  const std::vector<int>& joints() const { return joints_; }
  /// The shortest way, metres, from the line to an arm's forearm or hand, of which `turn` turns the
  /// arm about its shoulder. `positions`: of all joints, [3, joints].
  Eigen::Vector3d WayTo(const Arm& arm, const Eigen::Matrix3Xd& positions,
                        const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) const;

 private:
  int left_shoulder_, right_shoulder_;
  std::vector<int> joints_;
};

}  // namespace choreo
