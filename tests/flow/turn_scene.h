#pragma once

#include <numbers>

#include "model/flow/window/turn_prior.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/skeleton.h"

/// Dancers who must turn to a key.
namespace choreo::testing_support {

inline constexpr double kPi = std::numbers::pi;

inline const Skeleton& Body() { return Skeleton::Smpl24(); }

inline Pose Facing(double yaw) {
  Pose pose = RestPose(Body());
  pose.rotations.col(0) = Eigen::Vector3d(0, yaw, 0);
  return pose;
}

// A dancer who turns by `rate` a frame, and must face `yaw` after this many frames.
inline WindowRequest To(double yaw, double rate = 0, int frames = 60) {
  WindowRequest request{{.frames = frames, .target = Target{Facing(yaw), {}}}, frames};
  for (int i = 9; i >= 0; --i) request.history.push_back(Facing(-rate * i));
  return request;
}

// Dancers who turn already keep turning.
inline TurnPrior GoesOn() {
  TurnPrior prior;
  prior.weights[0] = -3;  // farther is rarer
  prior.weights[4] = 12;
  return prior;
}

}  // namespace choreo::testing_support
