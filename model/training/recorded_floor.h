#pragma once

#include <vector>

#include "model/fit/position_clip.h"

/// The floor under a recording: fit, level, and take out drift. Pure. `foot_joints` are at least
/// one of the clip's joints. Where they are asked for, Error(kInvalidArgument) refuses a clip that
/// is not valid.
namespace choreo {

/// A floor that may tilt: y = height + slope_x x + slope_z z.
struct FloorPlane {
  double height = 0;
  double slope_x = 0;
  double slope_z = 0;
};

/// The floor under a dancer, from the lowest of the given joints' positions: a robust plane that 95
/// % of them stand above, found together with a drift of its height in time (tang2018's floors
/// drift by up to 25 cm, which seen alone looks like a tilt). Slopes are zero where the dancer
/// covers less than a metre of ground in either direction, and never exceed 0.15.
FloorPlane FitFloorPlane(const PositionClip& clip, const std::vector<int>& foot_joints);

/// Turns the clip about the origin so that the plane becomes horizontal, and drops it to y = 0.
PositionClip LevelFloor(const PositionClip& clip, const FloorPlane& plane);

/// Takes out slow drift of the floor's height: the running 10th percentile of the lowest foot joint
/// over 8 s, smoothed over as long, is subtracted from every frame. Shorter jumps and lifts
/// survive.
PositionClip RemoveHeightDrift(const PositionClip& clip, const std::vector<int>& foot_joints);

}  // namespace choreo
