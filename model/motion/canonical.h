#pragma once

#include <Eigen/Core>
#include <span>

#include "model/motion/motion.h"

namespace choreo {

/// A frame on the floor: origin below a dancer's root, +Z along the heading. A transition's
/// canonical frame is that of its last history pose, so that moving or turning the scene moves the
/// dance and changes nothing else.
struct GroundFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< y = 0
  double heading = 0;                                ///< radians about +Y, 0 = +Z

  static GroundFrame Of(const Pose& pose);
  /// World → this frame. Keeps rotations' branches, except the root's; see NearestBranch.
  Pose ToLocal(const Pose& world) const;
  Eigen::Vector3d ToLocal(const Eigen::Vector3d& world) const;
  GroundFrame ToLocal(const GroundFrame& world) const;
  /// This frame → world.
  Pose ToWorld(const Pose& local) const;
};

/// The vertical in the root's own frame, unit.
Eigen::Vector3d UpOf(const Pose& pose);
/// How far the root's heading turns from a pose over those after it, radians about +Y. Whole turns
/// count.
double TurnOver(const Pose& from, std::span<const Pose> poses);
/// The mean direction of the roots' headings, radians about +Y; 0 for no poses.
double MeanFacing(std::span<const Pose> poses);

}  // namespace choreo
