#pragma once

#include <Eigen/Core>

namespace choreo {

/// w x v as a product with v.
inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& w) {
  Eigen::Matrix3d k;
  k << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return k;
}

}  // namespace choreo
