#pragma once

#include <vector>

#include "model/fit/position_clip.h"

/// The floor under a recording: fits it, levels it, and removes drift. Pure. `foot_joints`: at
/// least one of the clip's joints. Functions with `foot_joints` throw Error(kInvalidArgument) for
/// an invalid clip.
namespace choreo {

/// A floor that may tilt: y = height + slope_x x + slope_z z.
struct FloorPlane {
  double height = 0;
  double slope_x = 0;
  double slope_z = 0;
};

/// The floor under a dancer, from the lowest of the given joints: a robust plane with 95 % of them
/// above it, fitted together with a drift of its height in time (tang2018's floors drift by up to
/// 25 cm, which alone would look like a tilt). Slopes are zero in directions in which the dancer
/// covers less than a metre of ground, and never exceed 0.15.
FloorPlane FitFloorPlane(const PositionClip& clip, const std::vector<int>& foot_joints);

/// Turns the clip about the origin to make the plane horizontal, and moves it to y = 0.
PositionClip LevelFloor(const PositionClip& clip, const FloorPlane& plane);

/// Removes slow drift of the floor's height: subtracts from every frame the running 10th percentile
/// of the lowest foot joint over 8 s, smoothed over as long. Keeps jumps and lifts shorter than
/// that.
PositionClip RemoveHeightDrift(const PositionClip& clip, const std::vector<int>& foot_joints);

}  // namespace choreo
