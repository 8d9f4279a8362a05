#include "model/motion/motion.h"

#include "model/motion/rotation.h"

namespace choreo {

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

Pose Masked(const Pose& key, const PoseMask& mask, Pose open) {
  if (mask.root_position) open.root_position = key.root_position;
  for (Eigen::Index joint = 0; joint < open.rotations.cols(); ++joint) {
    if (mask.Asks(joint)) open.rotations.col(joint) = key.rotations.col(joint);
  }
  return open;
}

}  // namespace choreo
