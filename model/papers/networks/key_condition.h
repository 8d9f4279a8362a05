#pragma once

#include <Eigen/Core>

#include "model/motion/motion.h"
#include "model/papers/networks/flow_config.h"

namespace choreo {

/// Numbers of a frame's key condition: the key's position, rotations and what of them counts,
/// the embedding of the frames left, as wide as the features, and, of models of innovations, how
/// many these are, the key's own among them; 0: not known.
int KeyConditionWidth(const FlowConfig& config, int joints, int feature_width);

/// Of a double integrator (it has `velocity`, in frames) the acceleration that brings it over `way`
/// in `frames` with the least effort, in the first of them: what turns a key and the time left into
/// something to do now. frames >= 1.
template <typename Scalar>
Scalar AccelerationTo(Scalar way, Scalar velocity, Scalar frames) {
  return 6 * (way - frames * velocity) / ((frames + 1) * (2 * frames + 1));
}

/// What is known of each of `frames` frames before the first (paper F, Section 3.2.1 and Eq. 9),
/// [width, frames]. `key`: in the canonical frame; null: nothing is awaited.
Eigen::MatrixXf KeyConditions(const FlowConfig& config, int joints, int feature_width, int frames,
                              const Pose* key, const PoseMask& mask);

}  // namespace choreo
