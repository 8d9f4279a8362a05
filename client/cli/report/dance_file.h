#pragma once

#include <filesystem>

#include "client/edit.h"
#include "model/motion/skeleton.h"

namespace choreo::cli {

/// A dance from a file, and its skeleton.
struct DanceFile {
  Skeleton skeleton;
  client::FinishedDance dance;
};

/// Reads a motion (motion_input.h) with the contacts of our npz files. Throws as ReadMotion does,
/// and Error(kInvalidArgument) whose field is PATH:contacts.
DanceFile ReadDance(const std::filesystem::path& path);

/// Reads a dance on this skeleton. Refuses other bones: retargeting would change the dance.
client::FinishedDance ReadDance(const std::filesystem::path& path, const Skeleton& skeleton);

}  // namespace choreo::cli
