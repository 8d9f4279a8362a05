#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/fit/human_bones.h"

namespace choreo {

/// A rig whose names say nothing, as people mostly build them: a guess from where its joints stand,
/// for somebody to look at. `parents` (-1: none) and `places` [3, nodes] at rest, whichever axis is
/// up; toes say what is ahead, +Z without them. Nodes that are no `joints` are left out. Empty
/// where it looks like no body, and for more than 5,000 nodes. `upright`, where wanted: what turns
/// it so that Y is up, and its left and right lie along X. Pure.
HumanBones GuessBones(const std::vector<int>& parents, const Eigen::Matrix3Xd& places,
                      const std::vector<bool>& joints, Eigen::Matrix3d* upright = nullptr);

}  // namespace choreo
