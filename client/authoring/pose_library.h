#pragma once

#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::authoring {

/// A shipped key pose (client/poses/*.json), made by hand for this project. Touches the floor
/// unless it is a jump, faces +Z, around the origin; on SMPL's 24 joints, or those that it was
/// retargeted to.
struct LibraryPose {
  std::string id;
  std::string description;
  std::vector<std::string> tags;  ///< some of PoseTags()
  Pose pose;
};

/// The tags of poses: standing and travelling on the feet, jump in the air, floor on hands, knees
/// or the seat: each pose has exactly one of these, first. ending: no dance begins so.
const std::vector<std::string>& PoseTags();

/// All poses, by id. They are part of the program: no file is read.
const std::vector<LibraryPose>& PoseLibrary();

bool IsEnding(const LibraryPose& pose);

/// All poses on this skeleton (fit/retarget.h). Throws Error(kInvalidArgument) whose field is
/// "keyframes" if it lacks joints for retargeting.
std::vector<LibraryPose> PosesFor(const Skeleton& skeleton);
/// Those that keys are drawn from, all that stand or travel. Throws the same.
std::vector<LibraryPose> PosesToDance(const Skeleton& skeleton);

/// Throws Error(kNotFound) naming the existing ones.
const LibraryPose& FindLibraryPose(const std::string& id);

}  // namespace choreo::authoring
