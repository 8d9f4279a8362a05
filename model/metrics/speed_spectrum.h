#pragma once

#include <Eigen/Core>
#include <array>

#include "model/metrics/joint_track.h"

namespace choreo {

/// Edges of the bands in which movement is looked at, Hz: posture, sway, beat, accent, trembling,
/// noise. What is above 15 Hz or half the rate does not count.
inline constexpr std::array<double, 6> kBandEdges = {0, 1.5, 3, 6, 10, 15};
inline constexpr int kBands = static_cast<int>(kBandEdges.size()) - 1;

/// Mean power of the joints' velocities by band, (m/s)^2: [kBands, 2 * joints], of each joint along
/// the floor, then upwards. Joint 0 moves in the world, all others as seen from it. Velocities
/// stand under a Hann window, whose loss of power is made good. Throws Error(kInvalidArgument) for
/// fewer than 9 frames. Pure, thread-safe.
Eigen::MatrixXd SpeedSpectrum(const JointTrack& track, double fps);

}  // namespace choreo
