#pragma once

#include <Eigen/Core>
#include <algorithm>

/// The convex hull of two balls: the shape that every limb is drawn with.
namespace choreo {

struct RoundedCone {
  Eigen::Vector3f a, b;      ///< centres of the balls, metres
  float radius_a, radius_b;  ///< above zero, metres
};

/// One with the ball around it, which settles most questions without looking at the shape.
struct BoundedCone {
  RoundedCone shape;
  Eigen::Vector3f middle;
  float radius;

  explicit BoundedCone(const RoundedCone& cone)
      : shape(cone),
        middle(0.5f * (cone.a + cone.b)),
        radius(0.5f * (cone.b - cone.a).norm() + std::max(cone.radius_a, cone.radius_b)) {}

  /// Farther away than this from its middle it hides less than a hundredth of the sky.
  float SkyReach() const { return radius + 9 * 0.5f * (shape.radius_a + shape.radius_b); }
};

/// The unit normal at a point of the surface.
Eigen::Vector3f NormalAt(const RoundedCone& cone, const Eigen::Vector3f& point);

/// Distance from the surface (below zero inside) and the direction away from the axis; `normal` is
/// the surface's where the balls are of one size.
float SurfaceDistance(const RoundedCone& cone, const Eigen::Vector3f& point,
                      Eigen::Vector3f& normal);

}  // namespace choreo
