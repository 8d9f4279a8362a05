#pragma once

#include <cstdint>
#include <functional>

#include "model/fit/bones/find_bones.h"
#include "model/fit/rig_motion.h"
#include "model/formats/reading/motion_reading.h"
#include "model/motion/motion.h"

/// Reads a rig of any format as SMPL's body. Private to this folder.
namespace choreo {

/// The motion of a file's nodes.
struct NodeMotion {
  double fps = 0;
  std::vector<RigPlacement> rests = {};  ///< of all nodes: candidates for the rest pose, best first
  size_t rests_apart = 0;                ///< as in RigMotion
  int64_t count = 0;                     ///< frames
  std::function<RigPlacement(int64_t frame)> frame = {};
};

/// Finds the bones (fit/bones/find_bones.h) that `reading` assigns, or else of the body that it
/// names, or of the first body that moves, with a note if others move, too. Some may be missing.
/// Throws Error(kInvalidArgument) whose field is --body for a body that does not exist.
HumanBones FindBody(const RigNodes& nodes, const MotionReading& reading);

/// Finds the bones (FindBody), transfers their rotations to SMPL's body (fit/rig_motion.h), and
/// checks the result (motion_check.h). Throws UnknownBones, without a field, if bones are missing.
Motion FitNodes(RigNodes nodes, const NodeMotion& motion, const MotionReading& reading);

}  // namespace choreo
