#include "model/body/body_distance.h"

#include <algorithm>
#include <limits>

#include "model/body/doll.h"
#include "model/core/error.h"

namespace choreo {
namespace {

using Eigen::Vector3f;

/// The nearest points of two axes, as shares of their lengths (Ericson, Real-Time Collision
/// Detection, 5.1.9).
std::pair<float, float> NearestPoints(const RoundedCone& p, const RoundedCone& q,
                                      const Vector3f& moved) {
  const Vector3f along_p = p.b - p.a, along_q = q.b - q.a, between = p.a - q.a - moved;
  const float pp = along_p.squaredNorm(), qq = along_q.squaredNorm();
  const float pq = along_p.dot(along_q), pr = along_p.dot(between), qr = along_q.dot(between);
  const auto share = [](float part, float whole) {
    return whole > 0 ? std::clamp(part / whole, 0.0f, 1.0f) : 0;
  };
  const float on_p = share(pq * qr - pr * qq, pp * qq - pq * pq);
  const float on_q = share(pq * on_p + qr, qq);
  return {share(pq * on_q - pr, pp), on_q};
}

float Distance(const RoundedCone& p, const RoundedCone& q, const Vector3f& moved) {
  const auto [s, t] = NearestPoints(p, q, moved);
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
    for (const PlacedPart& part : BuildFigure(skeleton, pose)) {
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
