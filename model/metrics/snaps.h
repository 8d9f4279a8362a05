#pragma once

#include "model/metrics/joint_track.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// How often limbs snap straight or out of it, as legs do that are drawn to their full length:
/// steps (frame i to i + 1) in which a hinge turns faster than 240 degrees a second (8 degrees a
/// frame at 30 fps) from or to less than 5 degrees of flexion. Flexion is the angle between the
/// bones above and below the joint, 0 where they are in line. Each limb counts by itself.
struct Snaps {
  int knees = 0, elbows = 0;
};

/// Joints that the skeleton has no role for do not count.
Snaps CountSnaps(const Skeleton& skeleton, double fps, const JointTrack& track);

}  // namespace choreo
