#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/formats/motion_reading.h"
#include "model/formats/own_arrays.h"
#include "model/motion/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A path's extension in small letters, as in ".npz" of "DANCE.NPZ".
std::string SmallExtension(const std::filesystem::path& path);

/// The formats of motion files, by their extension, whose case does not matter: `.npz`
/// (amass_npz.h), `.bvh` (bvh.h), `.glb` and `.vrma` (gltf.h), and `.pkl` (pickle.h, as
/// amass_npz.h), which is only read.
bool IsMotionFile(const std::filesystem::path& path);

/// ".npz, .bvh, .glb, ...": those that are read, for help and messages.
std::string MotionFileExtensions();

/// Throws Error(kInvalidArgument) whose field is the path, naming the formats, unless IsMotionFile.
void RequireMotionFile(const std::filesystem::path& path);
/// The same of those that are written.
void RequireWrittenMotionFile(const std::filesystem::path& path);

/// A motion from a file, and the skeleton that it is of: SMPL's, or the one that an npz holds
/// (own_arrays.h) or that a BVH or glTF has (own_skeleton.h); any other rig is read as SMPL's body
/// (node_motion.h): sized by its legs, turned as its bones turn, put on the floor. At the file's
/// own rate. Throws Error(kInvalidArgument) whose field begins with the path for other extensions,
/// files without frames, values beyond motion/pose_limits.h and what the formats refuse;
/// UnknownBones where names tell too little; Error(kNotFound) where the file cannot be opened.
SkeletonMotion ReadMotion(const std::filesystem::path& path, const MotionReading& reading = {});

/// What becomes of a motion of other bones: it is retargeted (fit/retarget.h), or refused with
/// Error(kInvalidArgument) naming both skeletons.
enum class OtherSkeleton : uint8_t { kRetarget, kRefuse };

/// The same on this skeleton.
Motion ReadMotion(const std::filesystem::path& path, const Skeleton& skeleton,
                  OtherSkeleton other = OtherSkeleton::kRetarget,
                  const MotionReading& reading = {});

/// Writes a file, in the format of its extension; an npz is SMPL's or holds its skeleton, as above.
/// `contacts`, one a frame, go into an npz alone. Errors as above, and Error(kInternal) where the
/// file cannot be written.
void WriteMotion(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
                 const std::vector<Contacts>* contacts = nullptr);

}  // namespace choreo
