#pragma once

#include <vector>

#include "model/fit/sources/position_clip.h"

/// Fits the floor under a recording, levels it, and removes its drift. Pure functions.
/// `foot_joints` has at least one of the clip's joints; functions with it throw
/// Error(kInvalidArgument) for an invalid clip.
namespace choreo {

/// A tilted floor, metres: y = height + slope_x * x + slope_z * z.
struct FloorPlane {
  double height = 0;
  double slope_x = 0;
  double slope_z = 0;
};

/// Fits the floor under a dancer to each frame's lowest foot joint: a robust plane with 95 % of
/// these above it, and the drift of its height in time (up to 25 cm in tang2018, which could look
/// like a tilt). Slopes never exceed 0.15, and are zero along directions in which the dancer covers
/// less than a metre.
FloorPlane FitFloorPlane(const PositionClip& clip, const std::vector<int>& foot_joints);

/// Rotates the clip about the origin to make the plane horizontal, and moves the plane to y = 0.
PositionClip LevelFloor(const PositionClip& clip, const FloorPlane& plane);

/// Removes slow drift of the floor's height: subtracts from every frame the running 10th percentile
/// of the lowest foot joint over 8 s, smoothed over as long. Keeps jumps and lifts shorter than
/// that.
PositionClip RemoveHeightDrift(const PositionClip& clip, const std::vector<int>& foot_joints);

}  // namespace choreo
