#include "model/formats/reading/root_motion.h"

namespace choreo {

SplitMotion SplitAtRoot(const Motion& motion) {
  SplitMotion split{{}, {.fps = motion.fps, .frames = {}}};
  for (const Pose& pose : motion.frames) {
    split.way.push_back(GroundFrame::Of(pose));
    split.body.frames.push_back(split.way.back().ToLocal(pose));
  }
  return split;
}

Motion InPlace(Motion motion) {
  for (Pose& pose : motion.frames) pose.root_position.x() = pose.root_position.z() = 0;
  return motion;
}

}  // namespace choreo
