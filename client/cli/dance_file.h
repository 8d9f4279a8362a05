#pragma once

#include <filesystem>

#include "client/edit.h"
#include "model/motion/skeleton.h"

namespace choreo::cli {

/// A dance that a file holds, and the skeleton that it is of.
struct DanceFile {
  Skeleton skeleton;
  client::FinishedDance dance;
};

/// A motion (motion_input.h) with the contacts that an npz of ours has. Errors as ReadMotion;
/// Error(kInvalidArgument) whose field is PATH:contacts.
DanceFile ReadDance(const std::filesystem::path& path);

/// The same of this skeleton; one of other bones is refused: retargeted, it would not be the dance
/// that was to stay as it is.
client::FinishedDance ReadDance(const std::filesystem::path& path, const Skeleton& skeleton);

}  // namespace choreo::cli
