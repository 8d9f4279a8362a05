#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "model/core/grid.h"

namespace choreo {

/// One frame of a skeleton, in a world frame: right-handed, Y up, floor y = 0.
struct Pose {
  Eigen::Vector3d root_position =
      Eigen::Vector3d::Zero();  ///< of joint 0 (SMPL: the pelvis), metres
  Eigen::Matrix3Xd
      rotations;  ///< [3, joints] axis-angle (exponential map), radians, local to the parent
};

/// Foot contacts c_t of paper F, Section 3.2.1, in the order of Skeleton::feet: 1 on the floor, 0
/// off it; a model's may lie between.
using Contacts = std::array<float, 4>;

/// Frames at a constant rate. Exponential-map branches are continuous from frame to frame.
struct Motion {
  double fps = kModelFps;
  std::vector<Pose> frames;
};

/// Moves every rotation to the branch nearest to `previous`'s. The rotations themselves do not
/// change.
void MakeContinuous(Pose& pose, const Pose& previous);

/// The same from frame to frame, starting from an unchanged first frame.
void MakeContinuous(Motion& motion);

/// The same pose with each rotation written so that its quaternion (QuaternionFromExp) has the sign
/// of `previous`'s (their product is not negative), and as near to `previous` as that allows.
/// Quaternions then never jump between frames. The vectors equal MakeContinuous's except around
/// whole turns about a tilting axis, where no choice is continuous in time. Pure, thread-safe.
Pose KeepSigns(Pose pose, const Pose& previous);

/// The degrees of freedom of a pose that a key sets. An empty joint mask means all joints.
struct PoseMask {
  bool root_position = true;
  std::vector<bool> joints;  ///< [joints] or empty

  /// Whether it includes this joint's rotation.
  bool Constrains(Eigen::Index joint) const {
    return joints.empty() || joints[static_cast<size_t>(joint)];
  }
};

/// The key pose at the end of a transition.
struct Target {
  Pose pose;
  PoseMask mask;
  /// The root's height above the floor, metres, if the key leaves its position open. None: the
  /// height is open, too.
  std::optional<double> height = {};
};

/// `key` where `mask` includes it, `open` elsewhere. Both have the same joint count.
Pose Masked(const Pose& key, const PoseMask& mask, Pose open);

}  // namespace choreo
