#pragma once

#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A limb hangs from a joint with three or more children (pelvis, chest); the joints between those
/// are the trunk. Speeds are relative to the root, so that a running dancer does not snap.

/// Frames at which to cut a motion: in the step to them, the whole body snaps (the trunk, or two
/// limbs at once), or a limb does so too near to an end to be bridged. Ascending.
std::vector<int> FindBreaks(const Skeleton& skeleton, const Motion& motion);

struct LimbRepair {
  int frames = 0;  ///< interpolated, counted per limb
  int left = 0;    ///< jolts that were too dense
};

/// Captured limbs sometimes snap: a knee to the other side of its leg, a wrist across the body.
/// Interpolates such a limb's rotations from shortly before to shortly after, and changes nothing
/// else.
LimbRepair RepairLimbs(const Skeleton& skeleton, Motion& motion);

}  // namespace choreo
