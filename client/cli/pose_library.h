#pragma once

#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::cli {

/// One of the key poses that ship (client/poses/*.json), made by hand for this project. Stands on
/// the floor, facing +Z, around the origin; SMPL's 24 joints, or those that it was retargeted to.
struct LibraryPose {
  std::string id;
  std::string description;
  Pose pose;
};

/// All of them, by id. They are part of the program: no file is read.
const std::vector<LibraryPose>& PoseLibrary();

/// All of them as this skeleton takes them (motion/retarget.h). Throws Error(kInvalidArgument) that
/// asks for --keyframes where it has no joints that they could be retargeted to.
std::vector<LibraryPose> PoseLibrary(const Skeleton& skeleton);

/// Throws Error(kNotFound) naming those that there are.
const LibraryPose& FindLibraryPose(const std::string& id);

}  // namespace choreo::cli
