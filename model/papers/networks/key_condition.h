#pragma once

#include <Eigen/Core>

#include "model/motion/motion.h"
#include "model/papers/networks/flow_config.h"

namespace choreo {

/// The width of a frame's key condition: the key's position and rotations, its mask, the embedding
/// of the frames left (as wide as the features) and, with innovations, the number of frames left
/// including the key's (0: unknown).
int KeyConditionWidth(const FlowConfig& config, int joints, int feature_width);

/// The first acceleration with which a double integrator at `velocity` (per frame) covers the
/// distance `way` in `frames` >= 1 frames with the least effort. It converts a key and the time
/// left to an immediate goal.
template <typename Scalar>
Scalar AccelerationTo(Scalar way, Scalar velocity, Scalar frames) {
  return 6 * (way - frames * velocity) / ((frames + 1) * (2 * frames + 1));
}

/// The key conditions of `frames` frames (paper F, Section 3.2.1 and Eq. 9), [width, frames].
/// `key`: in the canonical frame, or null for no key.
Eigen::MatrixXf KeyConditions(const FlowConfig& config, int joints, int feature_width, int frames,
                              const Pose* key, const PoseMask& mask);

}  // namespace choreo
