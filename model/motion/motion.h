#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "model/core/grid.h"

namespace choreo {

/// A skeleton's pose in one frame. The world is right-handed, Y up, with the floor at y = 0.
struct Pose {
  Eigen::Vector3d root_position =
      Eigen::Vector3d::Zero();  ///< of joint 0 (SMPL: the pelvis), metres
  Eigen::Matrix3Xd
      rotations;  ///< [3, joints] axis-angle (exponential map), radians, local to the parent
};

/// Foot contacts, c_t of paper F (Section 3.2.1), in the order of Skeleton::feet: 1 on the floor, 0
/// off it. A model's contacts may lie between.
using Contacts = std::array<float, 4>;

/// A sequence of poses at a constant rate. Rotation vectors keep to one branch from frame to frame.
struct Motion {
  double fps = kModelFps;
  std::vector<Pose> frames;
};

/// Puts every rotation vector on the branch nearest to `previous`'s. The rotations do not change.
void MakeContinuous(Pose& pose, const Pose& previous);

/// Makes each frame continuous with the one before. The first frame stays unchanged.
void MakeContinuous(Motion& motion);

/// Returns the same pose with quaternions (QuaternionFromExp) that never flip sign from
/// `previous`'s: their product is not negative. Among such branches, each rotation vector takes the
/// one nearest to `previous`'s. The vectors equal MakeContinuous's, except around whole turns about
/// a tilting axis, where no choice is continuous in time. Pure, thread-safe.
Pose KeepSigns(Pose pose, const Pose& previous);

/// The degrees of freedom of a pose that a key constrains.
struct PoseMask {
  bool root_position = true;
  std::vector<bool> joints;  ///< [joints], or empty: all joints

  /// Whether the mask includes this joint's rotation.
  bool Constrains(Eigen::Index joint) const {
    return joints.empty() || joints[static_cast<size_t>(joint)];
  }
};

/// The key pose at the end of a transition.
struct Target {
  Pose pose;
  PoseMask mask;
  /// The root's height above the floor, metres, for a key that does not constrain the root
  /// position. None leaves the height open, too.
  std::optional<double> height = {};
};

/// Returns `key` where `mask` constrains it and `open` elsewhere. Both have the same joint count.
Pose Masked(const Pose& key, const PoseMask& mask, Pose open);

}  // namespace choreo
