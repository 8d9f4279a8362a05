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

/// A path's extension in small letters: ".npz" of "DANCE.NPZ".
std::string SmallExtension(const std::filesystem::path& path);

/// The formats of motion files, by their extension, whose case does not matter: `.npz`
/// (amass_npz.h), `.bvh` (bvh.h), `.glb` and `.vrma` (gltf.h), and `.pkl` (pickle.h, as
/// amass_npz.h), which is only read.
bool IsMotionFile(const std::filesystem::path& path);

/// ".npz, .bvh, .glb, ...": the readable ones, for help and messages.
std::string MotionFileExtensions();

/// Throws Error(kInvalidArgument) whose field is the path, naming the formats, unless IsMotionFile.
void RequireMotionFile(const std::filesystem::path& path);
/// The same for formats that can be written.
void RequireWrittenMotionFile(const std::filesystem::path& path);

/// Reads a motion and its skeleton at the file's own rate. The skeleton is SMPL's, or one stored in
/// an npz (own_arrays.h), BVH or glTF (own_skeleton.h). Any other rig is read as SMPL's body
/// (node_motion.h): scaled by its legs, with its bones' rotations, put on the floor. Throws
/// Error(kInvalidArgument), whose field begins with the path, for other extensions, files without
/// frames, values beyond motion/pose_limits.h and what the formats refuse; UnknownBones if names
/// tell too little; Error(kNotFound) if the file cannot be opened.
SkeletonMotion ReadMotion(const std::filesystem::path& path, const MotionReading& reading = {});

/// The treatment of a motion with other bones: retarget it (fit/retarget.h), or refuse it with
/// Error(kInvalidArgument) naming both skeletons.
enum class OtherSkeleton : uint8_t { kRetarget, kRefuse };

/// Reads the same on this skeleton.
Motion ReadMotion(const std::filesystem::path& path, const Skeleton& skeleton,
                  OtherSkeleton other = OtherSkeleton::kRetarget,
                  const MotionReading& reading = {});

/// Writes a file in the format of its extension; an npz of another skeleton than SMPL's contains
/// it. Only an npz stores `contacts`, one per frame. Throws what ReadMotion throws for values, and
/// Error(kInternal) if the file cannot be written.
void WriteMotion(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
                 const std::vector<Contacts>* contacts = nullptr);

}  // namespace choreo
