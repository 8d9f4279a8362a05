#include "model/motion/motion.h"

#include <numbers>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

Eigen::Vector3d SameSign(const Eigen::Vector3d& w, const Eigen::Vector3d& previous) {
  const Eigen::Vector3d nearest = NearestBranch(w, previous);
  if (QuaternionFromExp(nearest).dot(QuaternionFromExp(previous)) >= 0) return nearest;
  // One whole turn flips the sign; of two different vectors at least one is not zero.
  const Eigen::Vector3d& axis = nearest.norm() > 1e-12 ? nearest : previous;
  const Eigen::Vector3d turn = axis.normalized() * (2.0 * std::numbers::pi);
  if (nearest.dot(turn) <= previous.dot(turn)) return nearest + turn;
  return nearest - turn;
}

}  // namespace

void MakeContinuous(Pose& pose, const Pose& previous) {
  for (Eigen::Index joint = 0; joint < pose.rotations.cols(); ++joint) {
    pose.rotations.col(joint) =
        NearestBranch(pose.rotations.col(joint), previous.rotations.col(joint));
  }
}

void MakeContinuous(Motion& motion) {
  for (size_t frame = 1; frame < motion.frames.size(); ++frame) {
    MakeContinuous(motion.frames[frame], motion.frames[frame - 1]);
  }
}

Pose KeepSigns(Pose pose, const Pose& previous) {
  for (Eigen::Index joint = 0; joint < pose.rotations.cols(); ++joint) {
    pose.rotations.col(joint) = SameSign(pose.rotations.col(joint), previous.rotations.col(joint));
  }
  return pose;
}

Pose Masked(const Pose& key, const PoseMask& mask, Pose open) {
  if (mask.root_position) open.root_position = key.root_position;
  for (Eigen::Index joint = 0; joint < open.rotations.cols(); ++joint) {
    if (mask.Constrains(joint)) open.rotations.col(joint) = key.rotations.col(joint);
  }
  return open;
}

}  // namespace choreo
