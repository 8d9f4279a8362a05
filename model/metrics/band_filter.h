#pragma once

#include <Eigen/Core>

#include "model/metrics/joint_track.h"

/// Zero-phase filters: Butterworth of second order, forwards and then backwards, which halves the
/// amplitude at the edge (Winter, Biomechanics, 4th ed., section 3.4). Ends are mirrored through
/// their last value. Signals shorter than 4 frames are returned unchanged. `hz` is above 0 and
/// below fps / 2. Pure, thread-safe.
namespace choreo {

/// The part of `values`, one per frame, that is slower than `hz`.
Eigen::VectorXd LowPass(const Eigen::VectorXd& values, double fps, double hz);
/// LowPass of each joint coordinate.
JointTrack LowPass(const JointTrack& track, double fps, double hz);

}  // namespace choreo
