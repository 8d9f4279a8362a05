#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/core/grid.h"
#include "model/motion/controls/path_curve.h"

namespace choreo {

/// A request to guide the root over the floor, or to guide its height.
struct LeadRequest {
  int64_t first_frame = 0;  ///< absolute
  double fps = kModelFps;
  std::vector<const PathCurve*> curves;  ///< [frames] the curve of each frame; null: none
  Eigen::Vector3d axes = {1, 0, 1};      ///< 1 for each guided axis, 0 for the others
  PathPoint start;                       ///< the root in the frame before the first one
  std::optional<PathPoint> end;          ///< where the last frame must be; none: anywhere
  bool end_wins = true;  ///< which has precedence if there is no time for both: `end`, or the curve
  bool rests = false;    ///< comes to rest in the last frame; time along the curve slows down
};

struct Lead {
  Eigen::Matrix3Xd path;                             ///< [3, frames]; 0 in other axes
  Eigen::Vector3d missed = Eigen::Vector3d::Zero();  ///< distance from the curves to `end`
};

/// Computes a path that follows the curves without jumps. If a curve begins away from the dancer or
/// at another velocity, or ends away from `end`, the path bends to it smoothly: at 1 m/s if there
/// is time, and over at least half a second. Frames without a curve follow a cubic to the next
/// curve or to `end`; with neither, the root stays in place. `end_wins` decides if `end` follows
/// the last curve too soon to reach both. Pure.
Lead LeadPath(const LeadRequest& request);

}  // namespace choreo
