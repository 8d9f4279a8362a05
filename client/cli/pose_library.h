#pragma once

#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::cli {

/// One of the key poses that ship (client/poses/*.json), made by hand for this project. Touches
/// the floor unless it is a jump, faces +Z, around the origin; SMPL's 24 joints, or those that it
/// was retargeted to.
struct LibraryPose {
  std::string id;
  std::string description;
  std::vector<std::string> tags;  ///< some of PoseTags()
  Pose pose;
};

/// What poses are for: standing and travelling on the feet, jump in the air, floor on hands, knees
/// or the seat. Each pose has exactly one of these.
const std::vector<std::string>& PoseTags();

/// All of them, by id. They are part of the program: no file is read.
const std::vector<LibraryPose>& PoseLibrary();

/// Those that the keys of a dance are drawn from, all that stand or travel, as this skeleton takes
/// them (fit/retarget.h). Throws Error(kInvalidArgument) that asks for --keyframes where it has
/// no joints that they could be retargeted to.
std::vector<LibraryPose> PosesToDance(const Skeleton& skeleton);

/// Throws Error(kNotFound) naming those that there are.
const LibraryPose& FindLibraryPose(const std::string& id);

}  // namespace choreo::cli
