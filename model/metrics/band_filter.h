#pragma once

#include <Eigen/Core>

#include "model/metrics/joint_track.h"

/// Filters without delay: Butterworth of second order, forwards and then backwards, so that the
/// amplitude at the edge is halved (Winter, Biomechanics, 4th ed., section 3.4). Ends are mirrored
/// through their last value. What is shorter than 4 frames comes back as it is. `hz` is above 0 and
/// below fps / 2. Pure, thread-safe.
namespace choreo {

/// What of `values`, one a frame, is slower than `hz`.
Eigen::VectorXd LowPass(const Eigen::VectorXd& values, double fps, double hz);
/// LowPass of each coordinate of each joint.
JointTrack LowPass(const JointTrack& track, double fps, double hz);

}  // namespace choreo
