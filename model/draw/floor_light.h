#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "model/body/rounded_cone.h"

namespace choreo {

/// A part with the ball around it, which settles most questions without looking at the part.
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
  /// Farther away than this it hides less than a hundredth of the sky.
  bool HidesSky(const Eigen::Vector3f& point) const {
    const float reach = radius + 9 * 0.5f * (shape.radius_a + shape.radius_b);
    return (middle - point).squaredNorm() < reach * reach;
  }
};

/// Light that reaches the floor around a dancer, worked out on a grid as large as her shadow.
class FloorLight {
 public:
  /// `lamp`: unit, towards it. `lamp_spread`: its angular radius, radians.
  FloorLight(const std::vector<BoundedCone>& parts, const Eigen::Vector3f& lamp, float lamp_spread);

  /// At a point of the floor: of the full light, 0 to 1.
  float At(float x, float z) const;

 private:
  Eigen::Vector2f low_;
  int columns_, rows_;
  std::vector<float> light_;
};

}  // namespace choreo
