#pragma once

#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A limb is what hangs at a joint of three or more children (pelvis, chest); the joints between
/// those are the trunk. Speeds count relative to the root, so that a dancer who runs does not snap.

/// Frames at which a motion should be cut: the whole body (the trunk, or two limbs at once) snaps
/// on the way there from the frame before, or a limb does so near to an end, where nothing could
/// bridge it. Ascending.
std::vector<int> FindBreaks(const Skeleton& skeleton, const Motion& motion);

struct LimbRepair {
  int frames = 0;  ///< made anew, counted for each limb
  int left = 0;    ///< jolts that were too dense
};

/// Captured limbs sometimes snap: a knee to the other side of its leg, a wrist across the body.
/// Such a limb's rotations are interpolated from shortly before to shortly after; everything else
/// stays as it is.
LimbRepair RepairLimbs(const Skeleton& skeleton, Motion& motion);

}  // namespace choreo
