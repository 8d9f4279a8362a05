#pragma once

#include <Eigen/Core>
#include <array>

#include "model/metrics/joint_track.h"

namespace choreo {

/// Edges of the frequency bands of movement, Hz: posture, sway, beat, accent, trembling, noise.
/// Frequencies above 15 Hz or half the rate do not count.
inline constexpr std::array<double, 6> kBandEdges = {0, 1.5, 3, 6, 10, 15};
inline constexpr int kBands = static_cast<int>(kBandEdges.size()) - 1;

/// The mean power of joint velocities by band, (m/s)^2, [kBands, 2 * joints]: for each joint its
/// horizontal, then its vertical velocity. Joint 0 moves in the world, all others relative to it.
/// Corrects for the power that the Hann window removes. Throws Error(kInvalidArgument) for fewer
/// than 9 frames. Pure, thread-safe.
Eigen::MatrixXd SpeedSpectrum(const JointTrack& track, double fps);

}  // namespace choreo
