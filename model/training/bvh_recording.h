#pragma once

#include <filesystem>
#include <string>

#include "model/training/prepare.h"

namespace choreo {

/// A BVH of any hierarchy that fit/sources.h knows. Its unit is told by the dancer's legs,
/// its rate is the options' for this name, or the file's. Throws Error as ReadBvh and BvhSource do.
Recording ReadBvhRecording(const std::filesystem::path& path, const std::string& name,
                           const PrepareOptions& options);

}  // namespace choreo
