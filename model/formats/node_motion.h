#pragma once

#include <cstdint>
#include <functional>

#include "model/fit/find_bones.h"
#include "model/fit/rig_motion.h"
#include "model/formats/motion_reading.h"
#include "model/motion/motion.h"

/// Somebody else's rig, of whatever format, as SMPL's body. Private to this folder.
namespace choreo {

/// How a file moves its nodes.
struct NodeMotion {
  double fps = 0;
  std::vector<RigPlacement> rests = {};  ///< of all nodes: what may be its rest pose, best first
  size_t rests_apart = 0;                ///< of these, as RigMotion has it
  int64_t count = 0;                     ///< frames
  std::function<RigPlacement(int64_t frame)> frame = {};
};

/// The bones that `reading` says: its map's, those of the body that it names, or those of the first
/// that moves (fit/find_bones.h), which is noted where others do. Some may be missing. Throws
/// Error(kInvalidArgument) whose field is --body for a body that there is not.
HumanBones FindBody(const RigNodes& nodes, const MotionReading& reading);

/// Finds the bones (FindBody), turns SMPL's body as they turn (fit/rig_motion.h), and looks
/// at it (motion_check.h). Throws UnknownBones without a field where bones are missing.
Motion FitNodes(RigNodes nodes, const NodeMotion& motion, const MotionReading& reading);

}  // namespace choreo
