#include "model/body/rounded_cone.h"

#include <algorithm>
#include <cmath>

namespace choreo {

using Eigen::Vector3f;

Vector3f NormalAt(const RoundedCone& cone, const Vector3f& point) {
  // The mantle begins where the balls end; see Enter in cone_lanes.h.
  const Vector3f axis = cone.b - cone.a, from = point - cone.a;
  const float slope = cone.radius_a - cone.radius_b;
  const float taper = axis.squaredNorm() - slope * slope;
  const float s = axis.dot(from) - cone.radius_a * slope;
  if (taper <= 0) return (slope > 0 ? from : Vector3f(from - axis)).normalized();
  if (s <= 0) return from.normalized();
  if (s >= taper) return (from - axis).normalized();
  return (taper * from - s * axis).normalized();
}

float SurfaceDistance(const RoundedCone& cone, const Vector3f& point, Vector3f& normal) {
  const Vector3f axis = cone.b - cone.a;
  const float axis2 = std::max(1e-9f, axis.squaredNorm());
  const float s = std::clamp(axis.dot(point - cone.a) / axis2, 0.0f, 1.0f);
  const Vector3f from_axis = point - cone.a - s * axis;
  const float distance = from_axis.norm();
  normal = from_axis / std::max(1e-6f, distance);
  return distance - cone.radius_a - s * (cone.radius_b - cone.radius_a);
}

}  // namespace choreo
