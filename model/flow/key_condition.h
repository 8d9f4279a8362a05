#pragma once

#include <Eigen/Core>

#include "model/flow/flow_config.h"
#include "model/motion/motion.h"

namespace choreo {

/// Numbers of a frame's key condition: the key's position, rotations as 6D and what of them counts,
/// and the embedding of the frames left, as wide as the features.
int KeyConditionWidth(int joints, int feature_width);

/// What is known of each of `frames` frames before the first (paper F, Section 3.2.1 and Eq. 9),
/// [width, frames]. `key`: in the canonical frame; null: nothing is awaited.
Eigen::MatrixXf KeyConditions(const FlowConfig& config, int joints, int feature_width, int frames,
                              const Pose* key, const PoseMask& mask);

}  // namespace choreo
