#pragma once

#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Left-right mirroring in the plane x = 0. Pairs joints by name: left_x with right_x; others
/// mirror onto themselves. Exact for symmetric skeletons; SMPL's sides differ by a few millimetres
/// per bone.
namespace choreo {

/// The joint on the other side of each, [joints]. Throws Error(kInvalidArgument) naming a left_ or
/// right_ joint without a counterpart.
std::vector<int> MirrorPairs(const Skeleton& skeleton);

/// left_x for right_x and vice versa; other names unchanged.
std::string OtherSide(const std::string& name);

Pose Mirror(const std::vector<int>& pairs, const Pose& pose);
Pose Mirror(const Skeleton& skeleton, const Pose& pose);
Motion Mirror(const Skeleton& skeleton, const Motion& motion);

}  // namespace choreo
