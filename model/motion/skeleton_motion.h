#pragma once

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A motion and its skeleton.
struct SkeletonMotion {
  Skeleton skeleton;
  Motion motion;
};

}  // namespace choreo
