#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/motion/skeleton.h"

namespace choreo {

/// The skeleton of a file whose joints have our names, as in files that we write for skeletons
/// other than SMPL's. `names` and `parents` (-1: none) describe its nodes; `places` [3, nodes] are
/// their rest positions, metres, Y up, facing +Z. The root is the joint from which hips and
/// shoulders branch. The skeleton is named "own". None if a role of Skeleton::AssignRoles is
/// missing, if the root is named pelvis (SMPL's body, of any build), if the skeleton is not
/// upright, facing +Z and as large as a person, or if a parent comes after its child.
std::optional<Skeleton> OwnSkeleton(const std::vector<std::string>& names,
                                    const std::vector<int>& parents,
                                    const Eigen::Matrix3Xd& places);

}  // namespace choreo
