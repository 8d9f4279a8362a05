#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/core/grid.h"
#include "model/dance/root_path.h"

namespace choreo {

/// What to lead: the root over the floor, or its height.
struct LeadRequest {
  int64_t first_frame = 0;  ///< absolute
  double fps = kModelFps;
  std::vector<const PathCurve*> curves;  ///< [frames] the curve for each frame; null: none
  Eigen::Vector3d axes = {1, 0, 1};      ///< 1 for each axis led, 0 for the others
  PathPoint start;                       ///< the root in the frame before the first
  std::optional<PathPoint> end;          ///< where the last frame must be; none: anywhere
  bool end_wins = true;  ///< over a curve that leaves no time for both; else the curve does
  bool rests = false;    ///< in the last frame: the curve's time slows down towards it
};

struct Lead {
  Eigen::Matrix3Xd path;                             ///< [3, frames]; 0 in other axes
  Eigen::Vector3d missed = Eigen::Vector3d::Zero();  ///< from the curves to `end`
};

/// Follows the curves without a jump. If a curve begins away from the dancer or at another
/// velocity, or ends away from `end`, the path bends to it smoothly: at 1 m/s if there is time, and
/// over at least half a second. Frames without a curve follow a cubic to the next curve or to
/// `end`; with neither, the root stays in place. If `end` follows the last curve too soon for both,
/// `end_wins` says which one gives way. Pure.
Lead LeadPath(const LeadRequest& request);

}  // namespace choreo
