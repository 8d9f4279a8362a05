#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/formats/motion_reading.h"
#include "model/formats/own_arrays.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// glTF 2.0, binary (.glb), for Blender, three.js, Unity, Unreal and web pages. Metres, Y up,
/// facing +Z: as ours.
namespace choreo {

/// Writes a skeleton at rest on the floor, the doll of body/skin.h bound to it, and the motion as
/// an animation: one rotation channel per joint and one translation channel for the root, linear.
/// Numbers are floats. The animation's extras hold `fps`. Deterministic. Throws
/// Error(kInvalidArgument) for a motion without frames or with another joint count,
/// Error(kInternal) if the file cannot be written.
void WriteGlb(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion);

/// One of several dancers in a file.
struct NamedMotion {
  std::string name;
  Motion motion;
};
/// The same for several dancers on one skeleton, with nodes named NAME:JOINT: one body and skin
/// each, and one animation for all. Throws as above, and Error(kInvalidArgument) for no dancers,
/// and for motions with different rates or frame counts.
void WriteGlb(const std::filesystem::path& path, const Skeleton& skeleton,
              const std::vector<NamedMotion>& dancers);

/// Writes SMPL's body as VRM's avatars take a motion (.vrma, VRMC_vrm_animation 1.0): glTF binary
/// with nodes, the table of its human bones and the animation, without a mesh. At rest arms are
/// held out and it faces +Z, as VRM 1.0 has it; programs turn VRM 0.x round themselves. Errors as
/// above, and Error(kInvalidArgument) for another skeleton than SMPL's.
void WriteVrma(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion);

/// An animation of a file, the one that `reading` names or the first that moves most of a body's
/// bones: of `wanted`, if any, of SMPL's skeleton or of the file's own (own_skeleton.h), where
/// names, parents and rest offsets (kSameBone) are theirs; any other skeleton is read as SMPL's
/// (node_motion.h). At the rate of extras.fps, else of the channel with most keys, or 30 where that
/// is below 20: few keys are poses to pass. Throws Error(kNotFound) where the file cannot be
/// opened, Error(kInvalidArgument) whose field is the path and whose message names the part: no
/// glTF, no animation, sparse accessors, compressed ones, data outside its buffer, files beside
/// this one, more than a million frames; UnknownBones where its names tell too little.
SkeletonMotion ReadGlb(const std::filesystem::path& path, const Skeleton* wanted = nullptr,
                       const MotionReading& reading = {});

}  // namespace choreo
