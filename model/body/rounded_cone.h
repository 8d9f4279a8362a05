#pragma once

#include <Eigen/Core>
#include <algorithm>

/// The convex hull of two balls: the shape of every limb.
namespace choreo {

struct RoundedCone {
  Eigen::Vector3f a, b;      ///< centres of the balls, metres
  float radius_a, radius_b;  ///< positive, metres
};

/// A cone with its bounding ball, which answers most queries without the cone itself.
struct BoundedCone {
  RoundedCone shape;
  Eigen::Vector3f middle;
  float radius;

  explicit BoundedCone(const RoundedCone& cone)
      : shape(cone),
        middle(0.5f * (cone.a + cone.b)),
        radius(0.5f * (cone.b - cone.a).norm() + std::max(cone.radius_a, cone.radius_b)) {}

  /// The distance from its middle, metres, beyond which it hides less than a hundredth of the sky.
  float SkyReach() const { return radius + 9 * 0.5f * (shape.radius_a + shape.radius_b); }
};

/// The unit normal at a point on the surface.
Eigen::Vector3f NormalAt(const RoundedCone& cone, const Eigen::Vector3f& point);

/// Returns the distance from the surface, negative inside. Sets `normal` to the direction away from
/// the axis, which is the surface's normal if the balls have equal size.
float SurfaceDistance(const RoundedCone& cone, const Eigen::Vector3f& point,
                      Eigen::Vector3f& normal);

}  // namespace choreo
