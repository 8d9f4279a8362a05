#pragma once

#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Finds and repairs jolts of recordings. A limb hangs from a joint with three or more children
/// (pelvis, chest); the joints between such joints are the trunk. Speeds are relative to the root,
/// so that running is no jolt.

/// The frames at which to cut a motion, ascending. In the step to such a frame the whole body snaps
/// (the trunk, or two limbs at once), or a limb snaps too near to an end to be bridged.
std::vector<int> FindBreaks(const Skeleton& skeleton, const Motion& motion);

struct LimbRepair {
  int frames = 0;  ///< interpolated frames, counted per limb
  int left = 0;    ///< jolts that were too dense
};

/// Repairs limbs that snap, as in some recordings: a knee to the other side of its leg, a wrist
/// across the body. Interpolates such a limb's rotations from shortly before to shortly after, and
/// changes nothing else.
LimbRepair RepairLimbs(const Skeleton& skeleton, Motion& motion);

}  // namespace choreo
