#pragma once

#include <string>

#include "model/motion/skeleton.h"

namespace choreo::testing_support {

/// SMPL's body with trunk, arms and legs scaled by these factors.
inline Skeleton Proportions(double trunk, double arms, double legs) {
  Skeleton body = Skeleton::Smpl24();
  for (int joint = 1; joint < body.joints(); ++joint) {
    const std::string& name = body.joint_names[static_cast<size_t>(joint)];
    const auto is = [&](const char* part) { return name.ends_with(part); };
    const bool leg = is("_knee") || is("_ankle") || is("_foot");
    const bool arm = is("_elbow") || is("_wrist") || is("_hand");
    body.offsets.col(joint) *= leg ? legs : arm ? arms : trunk;
  }
  body.StandOnFloor(0.02 * legs);
  return body;
}

inline Skeleton ChildBody() { return Proportions(0.7, 0.58, 0.55); }
inline Skeleton LongLegs() { return Proportions(0.95, 1.05, 1.3); }

}  // namespace choreo::testing_support
