#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "model/body/rounded_cone.h"

namespace choreo {

/// Light on the floor around a dancer, computed once on a grid the size of the shadow. Immutable;
/// thread-safe.
class FloorLight {
 public:
  /// `lamp`: unit vector towards the lamp. `lamp_spread`: its angular radius, radians.
  FloorLight(const std::vector<BoundedCone>& parts, const Eigen::Vector3f& lamp, float lamp_spread);

  /// The share of full light at a point of the floor, 0 to 1. Metres.
  float At(float x, float z) const;
  /// Whether the light may be less than full anywhere in a rectangle of x and z.
  bool IsShaded(const Eigen::AlignedBox2f& floor) const { return grid_.intersects(floor); }

 private:
  Eigen::Vector2f low_;
  Eigen::AlignedBox2f grid_;
  int columns_, rows_;
  std::vector<float> light_;  // [rows, columns]
};

}  // namespace choreo
