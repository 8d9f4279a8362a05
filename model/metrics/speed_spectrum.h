#pragma once

#include <Eigen/Core>
#include <array>

#include "model/metrics/joint_track.h"

namespace choreo {

/// Edges of the frequency bands of movement, Hz: posture, sway, beat, accent, trembling, noise.
/// Ignores whatever is above 15 Hz or half the rate.
inline constexpr std::array<double, 6> kBandEdges = {0, 1.5, 3, 6, 10, 15};
inline constexpr int kBands = static_cast<int>(kBandEdges.size()) - 1;

/// Mean power of joint velocities by band, (m/s)^2: [kBands, 2 * joints], for each joint along the
/// floor, then vertically. Joint 0 moves in the world, all others relative to it. Corrects for the
/// power lost to the Hann window. Throws Error(kInvalidArgument) for fewer than 9 frames. Pure,
/// thread-safe.
Eigen::MatrixXd SpeedSpectrum(const JointTrack& track, double fps);

}  // namespace choreo
