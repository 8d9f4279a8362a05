#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/formats/arrays/own_arrays.h"
#include "model/formats/reading/motion_reading.h"
#include "model/formats/reading/root_motion.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Reads and writes binary glTF 2.0 (.glb), for Blender, three.js, Unity, Unreal and web pages.
/// Metres, Y up, facing +Z, like our motions.
namespace choreo {

/// Writes a skeleton at rest on the floor, the doll of body/skin.h bound to it, and the motion as
/// an animation: one rotation channel per joint and one translation channel for the root, linear.
/// Numbers are floats. With RootMotion::kRoot, a joint "root" on the floor, the pelvis's parent,
/// carries the body over the floor. The animation's extras hold `fps`. Deterministic. Throws
/// Error(kInvalidArgument) for a motion without frames or with another joint count,
/// Error(kInternal) if the file cannot be written.
void WriteGlb(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
              RootMotion root = RootMotion::kPelvis);

/// One of several dancers in a file.
struct NamedMotion {
  std::string name;
  Motion motion;
};
/// Writes several dancers on one skeleton, with nodes named NAME:JOINT, a body and a skin each, and
/// one animation for all. Throws the same, and Error(kInvalidArgument) for no dancers and for
/// motions with different rates or frame counts.
void WriteGlb(const std::filesystem::path& path, const Skeleton& skeleton,
              const std::vector<NamedMotion>& dancers, RootMotion root = RootMotion::kPelvis);

/// Writes a motion of SMPL's body for VRM avatars (.vrma, VRMC_vrm_animation 1.0): binary glTF with
/// nodes, the table of human bones and the animation, without a mesh. At rest the body faces +Z
/// with arms held out, as VRM 1.0 requires; programs turn VRM 0.x avatars themselves. Throws what
/// WriteGlb throws, and Error(kInvalidArgument) for a skeleton other than SMPL's.
void WriteVrma(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion);

/// Reads the animation that `reading` names, or the first that moves most of a body's bones. The
/// skeleton is `preferred` (if given), SMPL's or the file's own (own_skeleton.h) if names, parents
/// and rest offsets (kSameBone) match; any other rig is read as SMPL's body (node_motion.h). The
/// rate is extras.fps. Without it, it is the rate of the channel with most keys, or 30 if that rate
/// is below 20: so few keys are poses to interpolate. Throws Error(kNotFound) if the file cannot be
/// opened; Error(kInvalidArgument), whose field is the path and whose message names the part, if it
/// is no glTF, or has no animation, compressed accessors, data outside its buffer, data in other
/// files, or more than a million frames; UnknownBones if its names do not identify enough bones.
SkeletonMotion ReadGlb(const std::filesystem::path& path, const Skeleton* preferred = nullptr,
                       const MotionReading& reading = {});

}  // namespace choreo
