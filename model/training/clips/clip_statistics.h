#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "model/flow/priors/motion_prior.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/training/clips/clip_track.h"

namespace choreo {

/// The medians of the velocity factors over all frames, metres per frame.
std::array<double, kBodyParts> MedianFactors(std::span<const ClipTrack> tracks);

/// The autocovariance of velocities, [dimensions, lags], symmetrised over sides, for MotionPrior.
Eigen::MatrixXd VelocityCovariance(const Skeleton& skeleton, std::span<const ClipTrack> tracks,
                                   int lags);

/// The pose to which dancers return: the mean, symmetrised over sides, and the spread about it.
UsualPose MeasureUsualPose(const Skeleton& skeleton, std::span<const ClipTrack> tracks);

}  // namespace choreo
