#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/motion/controls/control_request.h"

namespace choreo {

/// A position and its velocity.
struct PathPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< metres per frame
};

/// The cubic from `from` to `to` over `duration` frames, evaluated `t` frames after its start.
PathPoint CubicBetween(const PathPoint& from, const PathPoint& to, double duration, double t);

/// The curve through a path's points: piecewise cubic in time, with continuous velocity. At a
/// point, the velocity is the slope of the parabola through it and its neighbours, at most three
/// times the speed of the slower adjacent leg. So the curve rests between equal points and does not
/// overshoot far. Moving or turning the points moves or turns the curve. Immutable.
class PathCurve {
 public:
  /// The path must be valid.
  explicit PathCurve(const RootPath& path);

  int64_t first() const { return frames_.front(); }
  int64_t last() const { return frames_.back(); }
  bool Covers(int64_t frame) const { return frame >= first() && frame <= last(); }
  bool has_heights() const { return has_heights_; }
  /// The position and velocity at a frame. The curve is straight before the first and after the
  /// last point. y is 0 without heights.
  PathPoint At(double frame) const;

 private:
  std::vector<int64_t> frames_;
  std::vector<PathPoint> points_;
  bool has_heights_;
};

}  // namespace choreo
