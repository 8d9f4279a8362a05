#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "model/motion/velocity_factors.h"
#include "model/training/clip_track.h"

namespace choreo {

/// Of all frames, metres a frame.
std::array<double, kBodyParts> MedianFactors(std::span<const ClipTrack> tracks);

/// [dimensions, lags] of velocities, both sides alike, as MotionPrior has it.
Eigen::MatrixXd VelocityCovariance(const Skeleton& skeleton, std::span<const ClipTrack> tracks,
                                   int lags);

/// Variance of where dancers are about their stage's middle, along one axis of the floor, m².
double Roaming(std::span<const ClipTrack> tracks);

}  // namespace choreo
