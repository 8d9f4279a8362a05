#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "model/motion/control_request.h"

namespace choreo {

/// Metres above the floor. A root at standing height is a metre lower, and nobody leaps that high.
inline constexpr double kMaxRootHeight = 2;

/// Throws Error(kInvalidArgument) below `field` for fewer than 2 points, frames that do not ascend
/// or lie outside a dance, points that are not finite or further than kMaxPosition from the origin,
/// a number of heights other than that of points, or heights outside [0, kMaxRootHeight].
void ValidatePath(const RootPath& path, const std::string& field);

/// A position and its velocity.
struct PathPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< metres a frame
};

/// The cubic that leads from `from` to `to` in `duration` frames, `t` frames after its start.
PathPoint CubicBetween(const PathPoint& from, const PathPoint& to, double duration, double t);

/// The curve through a path's points: cubic in time between two points, its velocity continuous. At
/// a point its velocity is that of the parabola through it and its neighbours, limited to three
/// times the slower adjacent leg's, so that the curve rests between equal points and does not
/// overshoot far. Moving or turning the points moves and turns the curve. Immutable.
class PathCurve {
 public:
  /// The path must be valid.
  explicit PathCurve(const RootPath& path);

  int64_t first() const { return frames_.front(); }
  int64_t last() const { return frames_.back(); }
  bool Covers(int64_t frame) const { return frame >= first() && frame <= last(); }
  bool has_heights() const { return has_heights_; }
  /// The curve is straight before the first and after the last point. y is 0 without heights.
  PathPoint At(double frame) const;

 private:
  std::vector<int64_t> frames_;
  std::vector<PathPoint> points_;
  bool has_heights_;
};

}  // namespace choreo
