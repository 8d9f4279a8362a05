#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/motion/skeleton.h"

namespace choreo {

/// The skeleton of a file that names its joints as ours do, if it has one: what we write for a
/// dance on a skeleton of its own, which no SMPL body could stand in for. `names` and `parents`
/// (-1: none) are those of its nodes, `places` [3, nodes] where they stand at rest, metres, Y up,
/// facing +Z. Its root is the joint from which hips and shoulders come. Named "own". None where a
/// role of Skeleton::AssignRoles is not played, where the root is SMPL's pelvis (such a file is one
/// of SMPL's body, of whatever build), where it does not stand so, in a person's size, or where a
/// parent stands behind its child.
std::optional<Skeleton> OwnSkeleton(const std::vector<std::string>& names,
                                    const std::vector<int>& parents,
                                    const Eigen::Matrix3Xd& places);

}  // namespace choreo
