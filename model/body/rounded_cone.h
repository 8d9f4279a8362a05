#pragma once

#include <Eigen/Core>

/// The convex hull of two balls: the shape that every limb is drawn with.
namespace choreo {

struct RoundedCone {
  Eigen::Vector3f a, b;      ///< centres of the balls, metres
  float radius_a, radius_b;  ///< above zero, metres
};

/// A ray's first touch. `distance` < 0: none.
struct RayHit {
  float distance = -1;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

/// The nearest point in front of `origin` where a ray of unit `direction` enters the shape.
RayHit Intersect(const RoundedCone& cone, const Eigen::Vector3f& origin,
                 const Eigen::Vector3f& direction);

/// Distance from the surface (below zero inside) and the direction away from the axis; `normal` is
/// the surface's where the balls are of one size.
float SurfaceDistance(const RoundedCone& cone, const Eigen::Vector3f& point,
                      Eigen::Vector3f& normal);

/// How much of a lamp of angular radius `spread` (radians) in the direction `light` the shape hides
/// from `point`, 0 to 1; an approximation that is exact in the middle of the shadow and outside.
float ShadowOf(const RoundedCone& cone, const Eigen::Vector3f& point, const Eigen::Vector3f& light,
               float spread);

/// How much of the sky above a surface with this normal the shape hides from `point`, 0 to 1.
float OcclusionBy(const RoundedCone& cone, const Eigen::Vector3f& point,
                  const Eigen::Vector3f& normal);

}  // namespace choreo
