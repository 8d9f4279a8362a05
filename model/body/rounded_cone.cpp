#include "model/body/rounded_cone.h"

#include <algorithm>
#include <cmath>

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr float kMinDistance = 1e-4f;  // a ray that starts on the surface does not meet it again

void Nearer(RayHit& hit, float distance, const Vector3f& normal) {
  if (distance > kMinDistance && (hit.distance < 0 || distance < hit.distance)) {
    hit = {distance, normal};
  }
}

void IntersectBall(const Vector3f& centre, float radius, const Vector3f& origin,
                   const Vector3f& direction, RayHit& hit) {
  const Vector3f from = origin - centre;
  const float along = direction.dot(from);
  const float root = along * along - from.squaredNorm() + radius * radius;
  if (root < 0) return;
  const float distance = -along - std::sqrt(root);
  Nearer(hit, distance, (from + distance * direction).normalized());
}

}  // namespace

RayHit Intersect(const RoundedCone& cone, const Vector3f& origin, const Vector3f& direction) {
  // The mantle: points at distance radius from the axis, measured along the slanted normal. With
  // s the axis coordinate (times the axis length) the mantle is a quadric in the ray's distance;
  // it ends where the balls begin, at s = 0 and s = taper.
  const Vector3f axis = cone.b - cone.a;
  const Vector3f from = origin - cone.a;
  const float slope = cone.radius_a - cone.radius_b;
  const float axis2 = axis.squaredNorm();
  const float taper = axis2 - slope * slope;
  RayHit hit;
  if (taper > 0) {
    const float axis_from = axis.dot(from), axis_ray = axis.dot(direction);
    const float ray_from = direction.dot(from), from2 = from.squaredNorm();
    const float k2 = taper - axis_ray * axis_ray;
    const float k1 = taper * ray_from - axis_from * axis_ray + axis_ray * slope * cone.radius_a;
    const float k0 = taper * from2 - axis_from * axis_from + 2 * axis_from * slope * cone.radius_a -
                     axis2 * cone.radius_a * cone.radius_a;
    const float root = k1 * k1 - k0 * k2;
    if (root < 0) return hit;  // the balls lie inside the mantle's cone
    if (std::abs(k2) > 1e-12f) {
      for (const float sign : {-1.0f, 1.0f}) {
        const float distance = (sign * std::sqrt(root) - k1) / k2;
        const float s = axis_from - cone.radius_a * slope + distance * axis_ray;
        if (s > 0 && s < taper) {
          Nearer(hit, distance, (taper * (from + distance * direction) - axis * s).normalized());
        }
      }
    }
  }
  // Of a convex hull, the nearest point on any of its parts is where the ray enters.
  IntersectBall(cone.a, cone.radius_a, origin, direction, hit);
  IntersectBall(cone.b, cone.radius_b, origin, direction, hit);
  return hit;
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
  const float gap =
      (to_axis - distance * light).norm() - (cone.radius_a + s * (cone.radius_b - cone.radius_a));
  const float penumbra = std::max(0.012f, distance * spread);
  const float cover = std::clamp(0.5f - 0.5f * gap / penumbra, 0.0f, 1.0f);
  return cover * cover * (3 - 2 * cover);
}

float SurfaceDistance(const RoundedCone& cone, const Vector3f& point, Vector3f& normal) {
  const Vector3f axis = cone.b - cone.a;
  const float axis2 = std::max(1e-9f, axis.squaredNorm());
  const float s = std::clamp(axis.dot(point - cone.a) / axis2, 0.0f, 1.0f);
  const Vector3f from_axis = point - cone.a - s * axis;
  const float distance = from_axis.norm();
  normal = from_axis / std::max(1e-6f, distance);
  return distance - (cone.radius_a + s * (cone.radius_b - cone.radius_a));
}

float OcclusionBy(const RoundedCone& cone, const Vector3f& point, const Vector3f& normal) {
  Vector3f away;
  const float gap = std::max(0.0f, SurfaceDistance(cone, point, away));
  const float radius = 0.5f * (cone.radius_a + cone.radius_b);
  const float part = radius / (radius + gap);
  return std::max(0.0f, -normal.dot(away)) * part * part;
}

}  // namespace choreo
