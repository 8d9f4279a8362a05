#pragma once

#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::authoring {

/// A shipped key pose (client/poses/*.json), made by hand for this project. It is around the
/// origin, faces +Z and, unless it is a jump, touches the floor. It has SMPL's 24 joints, or those
/// of the skeleton to which it was retargeted.
struct LibraryPose {
  std::string id;
  std::string description;
  std::vector<std::string> tags;  ///< some of PoseTags()
  Pose pose;
};

/// The tags of poses. The first tag of each pose, and only the first, is one of "standing" and
/// "travelling" (on the feet), "jump" (in the air) and "floor" (on hands, knees or the seat). No
/// dance begins with a pose tagged "ending".
const std::vector<std::string>& PoseTags();

/// All poses, sorted by id. They are compiled into the program.
const std::vector<LibraryPose>& PoseLibrary();

bool IsEnding(const LibraryPose& pose);

/// Retargets all poses to this skeleton (fit/retarget.h). Throws Error(kInvalidArgument) whose
/// field is "keyframes" if it lacks joints for retargeting.
std::vector<LibraryPose> PosesFor(const Skeleton& skeleton);
/// Returns the poses from which keys are drawn: all standing and travelling ones, retargeted to
/// this skeleton. Throws as PosesFor does.
std::vector<LibraryPose> PosesToDance(const Skeleton& skeleton);

/// Finds a pose by its id. Throws Error(kNotFound), naming the existing ids, if there is none.
const LibraryPose& FindLibraryPose(const std::string& id);

}  // namespace choreo::authoring
