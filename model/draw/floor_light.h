#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/body/rounded_cone.h"

namespace choreo {

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
  std::vector<float> light_;  // [rows, columns]
};

}  // namespace choreo
