#pragma once

#include <string>
#include <vector>

#include "model/motion/motion.h"

namespace choreo::cli {

/// One of the key poses that ship (client/poses/*.json), made by hand for this project. Stands on
/// the floor, facing +Z, around the origin; SMPL's 24 joints.
struct LibraryPose {
  std::string id;
  std::string description;
  Pose pose;
};

/// All of them, by id. They are part of the program: no file is read.
const std::vector<LibraryPose>& PoseLibrary();

/// Throws Error(kNotFound) naming those that there are.
const LibraryPose& FindLibraryPose(const std::string& id);

}  // namespace choreo::cli
