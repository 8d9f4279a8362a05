#pragma once

#include <Eigen/Core>
#include <span>

#include "model/motion/motion.h"

namespace choreo {

/// A frame of reference on the floor: its origin is below a dancer's root, and +Z is the root's
/// heading. A transition's canonical frame belongs to its last history pose, so moving or turning
/// the scene only moves or turns the dance.
struct GroundFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< y = 0
  double heading = 0;                                ///< radians about +Y, 0 = +Z

  /// The frame below this pose's root.
  static GroundFrame Of(const Pose& pose);
  /// Converts from the world to this frame. Rotation vectors keep their branches (see
  /// NearestBranch), except the root's.
  Pose ToLocal(const Pose& world) const;
  Eigen::Vector3d ToLocal(const Eigen::Vector3d& world) const;
  GroundFrame ToLocal(const GroundFrame& world) const;
  /// Converts from this frame to the world.
  Pose ToWorld(const Pose& local) const;
};

/// The world's vertical in the root's own frame, unit length.
Eigen::Vector3d UpOf(const Pose& pose);
/// The total turn of the root's heading from a pose over the poses after it, radians about +Y.
/// Counts whole turns.
double TurnOver(const Pose& from, std::span<const Pose> poses);
/// The mean direction of the roots' headings, radians about +Y; 0 for no poses.
double MeanFacing(std::span<const Pose> poses);

}  // namespace choreo
