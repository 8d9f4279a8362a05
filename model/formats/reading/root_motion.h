#pragma once

#include <vector>

#include "model/motion/kinematics/canonical.h"
#include "model/motion/motion.h"

/// The node that carries the dancer over the floor. Game engines move characters themselves: with a
/// clip in place, or by the track of a node on the floor (root motion).
namespace choreo {

enum class RootMotion {
  kPelvis,   ///< the pelvis, as in our motions
  kRoot,     ///< a node on the floor below the pelvis, with the dancer's heading
  kInPlace,  ///< none: the pelvis stays above the origin, but turns and rises as in the dance
};

/// A motion split into its path over the floor, one frame of reference per frame, and the motion
/// relative to that path.
struct SplitMotion {
  std::vector<GroundFrame> way;
  Motion body;
};
SplitMotion SplitAtRoot(const Motion& motion);

/// The motion without its path: SplitMotion::body.
Motion InPlace(Motion motion);

}  // namespace choreo
