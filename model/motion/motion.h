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

/// Foot contacts c_t of paper F, Section 3.2.1, of Skeleton::feet in their order: 1 on the floor, 0
/// off it. A model's may lie in between.
using Contacts = std::array<float, 4>;

/// Frames at a constant rate. Exponential-map branches are continuous from frame to frame.
struct Motion {
  double fps = kModelFps;
  std::vector<Pose> frames;
};

/// Puts every rotation on the branch nearest to `previous`'s. The rotations themselves do not
/// change.
void MakeContinuous(Pose& pose, const Pose& previous);

/// The same from frame to frame; the first frame stays as it is.
void MakeContinuous(Motion& motion);

/// The same pose, each rotation written so that its quaternion (QuaternionFromExp) has the sign of
/// `previous`'s, their product not negative: of those vectors the nearest to `previous`. From frame
/// to frame quaternions then never jump. The vectors are those of MakeContinuous, but around whole
/// turns about an axis that tilts, where no choice of vectors is continuous in time. Pure,
/// thread-safe.
Pose KeepSigns(Pose pose, const Pose& previous);

/// Which of a pose's degrees of freedom a key asks for. An empty joint mask means every joint.
struct PoseMask {
  bool root_position = true;
  std::vector<bool> joints;  ///< [joints] or empty

  /// Whether it asks for the rotation of this joint of the pose.
  bool Asks(Eigen::Index joint) const {
    return joints.empty() || joints[static_cast<size_t>(joint)];
  }
};

/// The key pose at the end of a transition.
struct Target {
  Pose pose;
  PoseMask mask;
  /// The root's above the floor, metres, of a key that leaves its position open. None: open too.
  std::optional<double> height = {};
};

/// `key` where `mask` asks for it, and `open` where it leaves the pose open. Both have as many
/// joints.
Pose Masked(const Pose& key, const PoseMask& mask, Pose open);

}  // namespace choreo
