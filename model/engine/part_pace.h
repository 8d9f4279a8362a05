#pragma once

#include <Eigen/Core>

#include "model/motion/velocity_factors.h"

/// Pace at generation: where a plan is slower or faster than velocity factors ask. Pure functions;
/// thread-safe. Positions are [3 joints, N + 1], metres, a column a frame, the first one danced
/// already: the root, then the other joints less the root, axes the world's, as VelocityFactors has
/// them. Factors are [5, N]. Those of a part may have a rhythm of their own, frame by frame, or
/// none, such as a constant: then it keeps the plan's rhythm.
namespace choreo {

/// Velocity factors of N frames, metres a frame.
using VelocityFactorTrack = Eigen::Matrix<double, kBodyParts, Eigen::Dynamic>;

/// What to ask of a network that, asked for `factors`, planned `planned`: of parts without a rhythm
/// as many times as much as they lack, half to twice as much; of others the factors themselves.
VelocityFactorTrack AskAgain(const BodyPartWeights& weights, const VelocityFactorTrack& factors,
                             const Eigen::MatrixXd& planned);

/// `planned` with its parts as fast as `factors` ask: each step of each joint becomes as many times
/// longer (or shorter) as its part is too slow (or too fast), and positions are those whose steps
/// come nearest to that while they stay near what was planned: a screened Poisson equation, which
/// changes what happens within two thirds of a second and leaves slower ways alone. The root stays,
/// and the first column; so does the last one where it is `held` by a key.
Eigen::MatrixXd PaceParts(const BodyPartWeights& weights, const VelocityFactorTrack& factors,
                          const Eigen::MatrixXd& planned, bool held);

}  // namespace choreo
