#pragma once

#include <vector>

#include "model/motion/canonical.h"
#include "model/motion/motion.h"

/// The part of a file that carries the dancer over the floor. Game engines move characters
/// themselves, by a clip in place or by the track of a node on the floor.
namespace choreo {

enum class RootMotion {
  kPelvis,   ///< the pelvis, as in our motions
  kRoot,     ///< a node on the floor below the pelvis, facing as the dancer does
  kInPlace,  ///< nobody: the pelvis stays above the origin; it turns and rises as danced
};

/// A motion, split into its way over the floor, a place a frame, and the motion about it.
struct SplitMotion {
  std::vector<GroundFrame> way;
  Motion body;
};
SplitMotion SplitAtRoot(const Motion& motion);

/// A motion that stays in place.
Motion InPlace(Motion motion);

}  // namespace choreo
