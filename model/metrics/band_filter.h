#pragma once

#include <Eigen/Core>

#include "model/metrics/joint_track.h"

/// Zero-phase filters: a second-order Butterworth filter, run forwards and then backwards, which
/// halves the amplitude at the edge (Winter, Biomechanics, 4th ed., section 3.4). Ends are extended
/// by odd reflection. Signals shorter than 4 frames stay unchanged. `hz` is above 0 and below fps /
/// 2. Pure, thread-safe.
namespace choreo {

/// The part of `values`, one per frame, below `hz`.
Eigen::VectorXd LowPass(const Eigen::VectorXd& values, double fps, double hz);
/// The same for each joint coordinate.
JointTrack LowPass(const JointTrack& track, double fps, double hz);

}  // namespace choreo
