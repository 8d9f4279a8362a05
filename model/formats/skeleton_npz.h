#pragma once

#include <vector>

#include "model/formats/npz.h"
#include "model/motion/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Motion of any skeleton in an npz: `root_positions` [F, 3] of joint 0, metres, Y up; `rotations`
/// [F, joints, 3], axis-angle, local; `fps`; `contacts` [F, 4] where they are known; and
/// `skeleton`, the text of motion/skeleton_json.h. What has SMPL's skeleton is written as
/// amass_npz.h says instead, so that SMPL's tools can read it.
namespace choreo {

/// A motion and the skeleton that it is of.
struct SkeletonMotion {
  Skeleton skeleton;
  Motion motion;
};

bool HasSkeletonMotion(const NpzArchive& npz);

/// Throws Error(kInvalidArgument) naming the array and what is wrong with its shape or values, or
/// what SkeletonFromJson refuses.
SkeletonMotion ReadSkeletonMotion(const NpzArchive& npz);

/// Throws Error(kInvalidArgument) for a motion without frames or of another joint count, or
/// contacts of another length.
void AddSkeletonMotion(const Skeleton& skeleton, const Motion& motion,
                       const std::vector<Contacts>* contacts, NpzArchive& npz);

}  // namespace choreo
