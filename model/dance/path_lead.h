#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/core/grid.h"
#include "model/dance/root_path.h"

namespace choreo {

/// What is to be led: the root over the floor, or its height.
struct LeadRequest {
  int64_t first_frame = 0;  ///< absolute
  double fps = kModelFps;
  std::vector<const PathCurve*> curves;  ///< [frames] the curve that speaks of a frame; null: none
  Eigen::Vector3d axes = {1, 0, 1};      ///< 1 for each axis led, 0 for the others
  PathPoint start;                       ///< the root's in the frame before the first
  std::optional<PathPoint> end;          ///< where the last frame has to be; none: anywhere
  bool end_wins = true;  ///< over a curve that leaves no time to reach both; else the curve does
};

struct Lead {
  Eigen::Matrix3Xd path;                             ///< [3, frames]; 0 in axes that are not led
  Eigen::Vector3d missed = Eigen::Vector3d::Zero();  ///< from what the curves said to `end`
};

/// Follows the curves without a jump. Where a curve begins beside the dancer, or ends beside `end`,
/// it is bent there smoothly, so that the detour is walked at 1 m/s where there is time and takes
/// half a second where it could be shorter. Frames without a curve are led over by a cubic: to the
/// next curve, to `end`, or, with neither, nowhere: the place is held. An `end` too soon behind the
/// last curve to be led to wins as one on the curve does, or is given up. A pure function.
Lead LeadPath(const LeadRequest& request);

}  // namespace choreo
