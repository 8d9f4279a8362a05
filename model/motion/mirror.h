#pragma once

#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Left-right mirroring in the plane x = 0. Joints are paired by name: left_x with right_x; the
/// others mirror onto themselves. Exact for a skeleton whose sides are mirror images; SMPL's differ
/// by a few millimetres a bone.
namespace choreo {

/// [joints] the joint on the other side. Throws Error(kInvalidArgument) naming a left_ or right_
/// joint without a counterpart.
std::vector<int> MirrorPairs(const Skeleton& skeleton);

/// left_x of right_x and the other way round; any other name as it is.
std::string OtherSide(const std::string& name);

Pose Mirror(const std::vector<int>& pairs, const Pose& pose);
Pose Mirror(const Skeleton& skeleton, const Pose& pose);
Motion Mirror(const Skeleton& skeleton, const Motion& motion);

}  // namespace choreo
