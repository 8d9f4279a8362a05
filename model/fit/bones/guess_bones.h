#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/fit/bones/human_bones.h"

namespace choreo {

/// Guesses the bones of a rig with meaningless names from the usual positions of joints. A person
/// should check the guess. `parents` (-1: none); `places` [3, nodes] at rest with any axis up. Toes
/// determine the front; without them, the front is +Z. Ignores nodes that are not `joints`. Returns
/// nothing for rigs that do not look like a body, and for more than 5,000 nodes. `upright`, if
/// given, receives the rotation that makes Y up and puts left and right along X. Pure.
HumanBones GuessBones(const std::vector<int>& parents, const Eigen::Matrix3Xd& places,
                      const std::vector<bool>& joints, Eigen::Matrix3d* upright = nullptr);

}  // namespace choreo
