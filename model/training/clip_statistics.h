#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "model/flow/motion_prior.h"
#include "model/motion/velocity_factors.h"
#include "model/training/clip_track.h"

namespace choreo {

/// Of all frames, metres a frame.
std::array<double, kBodyParts> MedianFactors(std::span<const ClipTrack> tracks);

/// [dimensions, lags] of velocities, both sides alike, as MotionPrior has it.
Eigen::MatrixXd VelocityCovariance(const Skeleton& skeleton, std::span<const ClipTrack> tracks,
                                   int lags);

/// What dancers come back to: the mean pose, of both sides alike, and how they vary about it.
UsualPose MeasureUsualPose(const Skeleton& skeleton, std::span<const ClipTrack> tracks);

}  // namespace choreo
