#include "model/motion/controls/path_curve.h"

#include <algorithm>
#include <cmath>

namespace choreo {

PathPoint CubicBetween(const PathPoint& from, const PathPoint& to, double duration, double t) {
  const double s = t / duration;
  const Eigen::Vector3d leg = to.position - from.position;
  const Eigen::Vector3d m0 = from.velocity * duration, m1 = to.velocity * duration;
  const Eigen::Vector3d c2 = 3 * leg - 2 * m0 - m1, c3 = m0 + m1 - 2 * leg;
  return {from.position + s * (m0 + s * (c2 + s * c3)),
          (m0 + s * (2 * c2 + 3 * s * c3)) / duration};
}

PathCurve::PathCurve(const RootPath& path)
    : frames_(path.frames), points_(path.frames.size()), has_heights_(!path.heights.empty()) {
  for (size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector2d& point = path.points[i];
    points_[i].position = {point.x(), has_heights_ ? path.heights[i] : 0, point.y()};
  }
  const auto duration = [this](size_t leg) {
    return static_cast<double>(frames_[leg + 1] - frames_[leg]);
  };
  const auto slope = [&](size_t leg) -> Eigen::Vector3d {
    return (points_[leg + 1].position - points_[leg].position) / duration(leg);
  };
  const size_t end = points_.size() - 1;
  if (end == 1) {
    points_[0].velocity = points_[1].velocity = slope(0);
    return;
  }
  for (size_t point = 0; point <= end; ++point) {
    // The first of the parabola's two legs. End points use their neighbour's parabola.
    const size_t leg = std::clamp<size_t>(point, 1, end - 1) - 1;
    const double d0 = duration(leg), d1 = duration(leg + 1);
    const Eigen::Vector3d bend = (slope(leg + 1) - slope(leg)) / (d0 + d1);
    const double since = static_cast<double>(frames_[point] - frames_[leg]);
    const double slower = std::min(slope(point == 0 ? 0 : point - 1).norm(),
                                   slope(point == end ? end - 1 : point).norm());
    Eigen::Vector3d& velocity = points_[point].velocity;
    velocity = slope(leg) + (2 * since - d0) * bend;
    const double length = velocity.norm();
    if (length > 3 * slower) velocity *= 3 * slower / length;
  }
}

PathPoint PathCurve::At(double frame) const {
  const auto straight = [&](const PathPoint& end, int64_t end_frame) -> PathPoint {
    return {end.position + (frame - static_cast<double>(end_frame)) * end.velocity, end.velocity};
  };
  if (frame <= static_cast<double>(first())) return straight(points_.front(), first());
  if (frame >= static_cast<double>(last())) return straight(points_.back(), last());
  const auto after = std::ranges::upper_bound(frames_, static_cast<int64_t>(std::floor(frame)));
  const auto leg = static_cast<size_t>(after - frames_.begin()) - 1;
  return CubicBetween(points_[leg], points_[leg + 1],
                      static_cast<double>(frames_[leg + 1] - frames_[leg]),
                      frame - static_cast<double>(frames_[leg]));
}

}  // namespace choreo
