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

  bool MeetsRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
    const Eigen::Vector3f to = middle - origin;
    const float along = to.dot(direction);
    return along > -radius && to.squaredNorm() - along * along < radius * radius;
  }
  /// Farther away than this from its middle it hides less than a hundredth of the sky.
  float SkyReach() const { return radius + 9 * 0.5f * (shape.radius_a + shape.radius_b); }
  bool HidesSky(const Eigen::Vector3f& point) const {
    return (middle - point).squaredNorm() < SkyReach() * SkyReach();
  }
};

/// A ray's first touch. `distance` < 0: none.
struct RayHit {
  float distance = -1;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

/// A shape as rays from one point meet it.
class SeenCone {
 public:
  SeenCone(const RoundedCone& cone, const Eigen::Vector3f& origin);

  /// The nearest point in front of the origin where a ray of unit `direction` enters the shape.
  RayHit Enter(const Eigen::Vector3f& direction) const;

 private:
  RoundedCone cone_;
  Eigen::Vector3f axis_, from_;
  float slope_, taper_, axis_from_, k0_;
};

inline RayHit Intersect(const RoundedCone& cone, const Eigen::Vector3f& origin,
                        const Eigen::Vector3f& direction) {
  return SeenCone(cone, origin).Enter(direction);
}

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
