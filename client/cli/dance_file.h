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

/// A motion (motion_input.h) with the contacts of our npz files. Fails like ReadMotion;
/// Error(kInvalidArgument) whose field is PATH:contacts.
DanceFile ReadDance(const std::filesystem::path& path);

/// The same on this skeleton. Refuses other bones: a retargeted dance would not stay as it is.
client::FinishedDance ReadDance(const std::filesystem::path& path, const Skeleton& skeleton);

}  // namespace choreo::cli
