#pragma once

#include <filesystem>
#include <vector>

#include "model/motion/contacts.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A motion of our skeleton from a file, by its extension: `.npz` (amass_npz.h) or `.bvh`. A BVH of
/// another skeleton is fitted to ours (motion/fit.h): sized by its legs, turned into rotations, put
/// on the floor. At the file's own rate. Throws Error(kInvalidArgument) whose field begins with the
/// path for other extensions, files without frames and what the formats refuse; Error(kNotFound)
/// where the file cannot be opened.
Motion ReadMotion(const std::filesystem::path& path, const Skeleton& skeleton);

/// Writes `.npz` or `.bvh`, by the extension. `contacts`, one a frame, go into an npz and are left
/// out of a BVH. Errors as above, and Error(kInternal) where the file cannot be written.
void WriteMotion(const std::filesystem::path& path, const Skeleton& skeleton, const Motion& motion,
                 const std::vector<Contacts>* contacts = nullptr);

}  // namespace choreo
