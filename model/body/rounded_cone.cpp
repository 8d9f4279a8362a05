#include "model/body/rounded_cone.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr float kMinDistance = 1e-4f;  // a ray that starts on the surface does not meet it again

// What leads to a point from the nearest one of the axis, which is the share `s` of the way along.
Vector3f FromAxis(const RoundedCone& cone, const Vector3f& point, float& s) {
  const Vector3f axis = cone.b - cone.a;
  const float axis2 = std::max(1e-9f, axis.squaredNorm());
  s = std::clamp(axis.dot(point - cone.a) / axis2, 0.0f, 1.0f);
  return point - cone.a - s * axis;
}

float RadiusAt(const RoundedCone& cone, float s) {
  return cone.radius_a + s * (cone.radius_b - cone.radius_a);
}

}  // namespace

// The mantle: points at distance radius from the axis, measured along the slanted normal. With s
// the axis coordinate (times the axis length) the mantle is a quadric in the ray's distance; it
// ends where the balls begin, at s = 0 and s = taper.
SeenCone::SeenCone(const RoundedCone& cone, const Vector3f& origin)
    : cone_(cone),
      axis_(cone.b - cone.a),
      from_(origin - cone.a),
      slope_(cone.radius_a - cone.radius_b),
      taper_(axis_.squaredNorm() - slope_ * slope_),
      axis_from_(axis_.dot(from_)),
      k0_(taper_ * from_.squaredNorm() - axis_from_ * axis_from_ +
          2 * axis_from_ * slope_ * cone.radius_a -
          axis_.squaredNorm() * cone.radius_a * cone.radius_a) {}

RayHit SeenCone::Enter(const Vector3f& direction) const {
  float nearest = -1;
  Vector3f normal = Vector3f::Zero();  // not yet of unit length
  const auto meet = [&](float distance, const auto& normal_there) {
    if (distance <= kMinDistance || (nearest >= 0 && distance >= nearest)) return;
    nearest = distance;
    normal = normal_there(distance);
  };
  if (taper_ > 0) {
    const float axis_ray = axis_.dot(direction), ray_from = direction.dot(from_);
    const float k2 = taper_ - axis_ray * axis_ray;
    const float k1 = taper_ * ray_from - axis_from_ * axis_ray + axis_ray * slope_ * cone_.radius_a;
    const float root = k1 * k1 - k0_ * k2;
    if (root < 0) return {};  // the balls lie inside the mantle's cone
    if (std::abs(k2) > 1e-12f) {
      for (const float sign : {-1.0f, 1.0f}) {
        const float along = (sign * std::sqrt(root) - k1) / k2;
        const float s = axis_from_ - cone_.radius_a * slope_ + along * axis_ray;
        if (!(s > 0 && s < taper_)) continue;
        meet(along, [&](float distance) -> Vector3f {
          return taper_ * (from_ + distance * direction) - axis_ * s;
        });
        // The hull is convex and holds the balls: what enters by the mantle has met neither.
        if (sign < 0 && k2 > 0 && nearest >= 0) return {nearest, normal.normalized()};
      }
    }
  }
  // Of a convex hull, the nearest point on any of its parts is where the ray enters.
  for (const auto& [from_centre, radius] :
       {std::pair<Vector3f, float>(from_, cone_.radius_a),
        std::pair<Vector3f, float>(from_ - axis_, cone_.radius_b)}) {
    const float along = direction.dot(from_centre);
    const float root = along * along - from_centre.squaredNorm() + radius * radius;
    if (root < 0) continue;
    meet(-along - std::sqrt(root), [&, &centre = from_centre](float distance) -> Vector3f {
      return centre + distance * direction;
    });
  }
  if (nearest < 0) return {};
  return {nearest, normal.normalized()};
}

float ShadowOf(const RoundedCone& cone, const Vector3f& point, const Vector3f& light,
               float spread) {
  // Where the ray to the light and the axis come closest.
  const Vector3f axis = cone.b - cone.a;
  const Vector3f to_a = cone.a - point;
  const float axis2 = axis.squaredNorm(), axis_light = axis.dot(light);
  const float determinant = axis2 - axis_light * axis_light;
  float s = 0.5f;
  if (determinant > 1e-9f) {
    s = std::clamp((axis_light * to_a.dot(light) - axis.dot(to_a)) / determinant, 0.0f, 1.0f);
  }
  const Vector3f to_axis = to_a + s * axis;
  const float distance = to_axis.dot(light);
  if (distance <= 0) return 0;
  const float gap = (to_axis - distance * light).norm() - RadiusAt(cone, s);
  const float penumbra = std::max(0.012f, distance * spread);
  const float cover = std::clamp(0.5f - 0.5f * gap / penumbra, 0.0f, 1.0f);
  return cover * cover * (3 - 2 * cover);
}

float SurfaceDistance(const RoundedCone& cone, const Vector3f& point, Vector3f& normal) {
  float s;
  const Vector3f from_axis = FromAxis(cone, point, s);
  const float distance = from_axis.norm();
  normal = from_axis / std::max(1e-6f, distance);
  return distance - RadiusAt(cone, s);
}

float OcclusionBy(const RoundedCone& cone, const Vector3f& point, const Vector3f& normal) {
  float s;
  const Vector3f from_axis = FromAxis(cone, point, s);
  const float facing = -normal.dot(from_axis);
  if (facing <= 0) return 0;
  const float distance = from_axis.norm();
  const float gap = std::max(0.0f, distance - RadiusAt(cone, s));
  const float radius = 0.5f * (cone.radius_a + cone.radius_b);
  const float part = radius / (radius + gap);
  return facing / std::max(1e-6f, distance) * part * part;
}

}  // namespace choreo
