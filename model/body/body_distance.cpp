#include "model/body/body_distance.h"

#include <algorithm>
#include <limits>

#include "model/body/doll.h"
#include "model/core/error.h"
#include "model/motion/nearest_points.h"

namespace choreo {
namespace {

using Eigen::Vector3f;

float Distance(const RoundedCone& p, const RoundedCone& q, const Vector3f& moved) {
  const auto [s, t] = NearestPoints<Vector3f>(p.a, p.b, q.a + moved, q.b + moved);
  const Vector3f between = (1 - s) * p.a + s * p.b - (1 - t) * q.a - t * q.b - moved;
  return between.norm() - (1 - s) * p.radius_a - s * p.radius_b - (1 - t) * q.radius_a -
         t * q.radius_b;
}

}  // namespace

MovingBody::MovingBody(const Skeleton& skeleton, const Motion& motion) {
  for (const Pose& pose : motion.frames) {
    Frame& frame = frames_.emplace_back();
    frame.middle = pose.root_position.cast<float>();
    frame.radius = 0;
    for (const PlacedPart& part : BuildDoll(skeleton, pose)) {
      const BoundedCone& cone = frame.parts.emplace_back(part.shape);
      frame.radius = std::max(frame.radius, (cone.middle - frame.middle).norm() + cone.radius);
    }
  }
}

BodyDistance LeastDistance(const MovingBody& a, const MovingBody& b, const Eigen::Vector3d& moved) {
  const int64_t frames = std::min(a.frames(), b.frames());
  if (frames == 0) throw InvalidArgument("motion.frames", "0 frames, at least 1 is needed");
  const Vector3f by = moved.cast<float>();
  float least = std::numeric_limits<float>::infinity();
  BodyDistance nearest;
  for (int64_t i = 0; i < frames; ++i) {
    const auto& here = a.frames_[static_cast<size_t>(i)];
    const auto& there = b.frames_[static_cast<size_t>(i)];
    if ((here.middle - there.middle - by).norm() - here.radius - there.radius >= least) continue;
    for (const BoundedCone& p : here.parts) {
      for (const BoundedCone& q : there.parts) {
        if ((p.middle - q.middle - by).norm() - p.radius - q.radius >= least) continue;
        const float distance = Distance(p.shape, q.shape, by);
        if (distance >= least) continue;
        least = distance;
        nearest = {distance, i};
      }
    }
  }
  return nearest;
}

}  // namespace choreo
