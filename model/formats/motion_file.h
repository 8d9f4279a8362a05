#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/formats/arrays/own_arrays.h"
#include "model/formats/reading/motion_reading.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Whether a path has the extension of a readable motion format, in any case: `.npz` (amass_npz.h),
/// `.bvh` (bvh.h), `.glb` and `.vrma` (gltf.h), or `.pkl` (pickle.h, with the layouts of
/// amass_npz.h), which can only be read.
bool IsMotionFile(const std::filesystem::path& path);

/// The readable extensions for help and messages: ".npz, .bvh, .glb, ...".
std::string MotionFileExtensions();

/// Throws Error(kInvalidArgument), whose field is the path and whose message names the formats,
/// unless IsMotionFile.
void RequireMotionFile(const std::filesystem::path& path);
/// The same for formats that WriteMotion supports.
void RequireWrittenMotionFile(const std::filesystem::path& path);

/// Reads a motion and its skeleton at the file's own rate. The skeleton is SMPL's, or one stored in
/// an npz (own_arrays.h), BVH or glTF (own_skeleton.h). Any other rig is read as SMPL's body
/// (node_motion.h): scaled by its legs, with its bones' rotations, put on the floor. Throws
/// Error(kInvalidArgument), whose field begins with the path, for other extensions, files without
/// frames, values beyond motion/pose/pose_limits.h and what the formats refuse; UnknownBones if
/// names do not identify enough bones; Error(kNotFound) if the file cannot be opened.
SkeletonMotion ReadMotion(const std::filesystem::path& path, const MotionReading& reading = {});

/// The treatment of a motion with other bones: retarget it (fit/retarget.h), or refuse it with
/// Error(kInvalidArgument), which names both skeletons.
enum class OtherSkeleton : uint8_t { kRetarget, kRefuse };

/// Reads a motion on this skeleton.
Motion ReadMotion(const std::filesystem::path& path, const Skeleton& skeleton,
                  OtherSkeleton other = OtherSkeleton::kRetarget,
                  const MotionReading& reading = {});

/// Writes a file in the format of its extension. An npz contains the skeleton if it is not SMPL's.
/// Only an npz stores `contacts`, one per frame. Throws what ReadMotion throws for values, and
/// Error(kInternal) if the file cannot be written.
void WriteMotion(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
                 const std::vector<Contacts>* contacts = nullptr);

}  // namespace choreo
