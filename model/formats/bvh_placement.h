#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "model/formats/bvh.h"

namespace choreo {

/// Where a joint stands in its parent, file units, and how it is turned there.
struct BvhPlacement {
  Eigen::Vector3d position;
  Eigen::Matrix3d rotation;
};

/// Of the joint's channels, `values` are those of one frame.
inline BvhPlacement PlaceBvhJoint(const BvhJoint& joint, const double* values) {
  BvhPlacement local{joint.offset, Eigen::Matrix3d::Identity()};
  for (const BvhChannel channel : joint.channels) {
    const double value = *values++;
    const int axis = static_cast<int>(channel) % 3;
    if (channel <= BvhChannel::kZPosition) {
      local.position[axis] = value;
    } else {
      local.rotation *= Eigen::AngleAxisd(value * M_PI / 180, Eigen::Vector3d::Unit(axis)).matrix();
    }
  }
  return local;
}

}  // namespace choreo
