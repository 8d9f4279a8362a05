#pragma once

#include <Eigen/Core>

#include "model/metrics/joint_track.h"

namespace choreo {

/// Kinetic features of a motion (Onuma et al. 2008, "FMDistance"), [3 * joints]: of each joint its
/// mean horizontal kinetic energy and its mean vertical one, (m/s)^2 for unit mass, and its mean
/// energy expenditure, taken as the magnitude of its acceleration, m/s^2. The features of FID_k and
/// Div_k (Li et al. 2021).
///
/// Velocities and accelerations are means over the steps at most two frames away, which keeps
/// measurement noise out, as the field's implementation does. Throws Error(kInvalidArgument) for
/// fewer than three frames.
Eigen::VectorXd KineticFeatures(const JointTrack& track, double fps);

}  // namespace choreo
