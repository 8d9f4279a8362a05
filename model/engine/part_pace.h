#pragma once

#include <Eigen/Core>

#include "model/motion/velocity_factors.h"

/// Pace at generation: where a plan is slower or faster than velocity factors ask. Pure functions;
/// thread-safe. Positions are [3 joints, N + 1], metres, a column a frame, the first one danced
/// already: the root, then the other joints less the root, axes the world's, as VelocityFactors has
/// them. Factors are [5, N]. Those of a part may have a rhythm of their own, or none, such as a
/// constant: then it keeps the plan's.
namespace choreo {

/// Velocity factors of N frames, metres a frame.
using VelocityFactorTrack = Eigen::Matrix<double, kBodyParts, Eigen::Dynamic>;

/// What to ask of a network that, asked for `factors`, planned `planned`: wherever a part is too
/// slow or too fast by more than a tenth over some 20 frames, as many times as much again as it is
/// beyond that, half to twice as much. The more factors vary, the less: those of real dances are
/// what networks have learnt to answer.
VelocityFactorTrack AskAgain(const BodyPartWeights& weights, const VelocityFactorTrack& factors,
                             const Eigen::MatrixXd& planned);

/// `planned` with its parts as fast as `factors` ask: each step of each joint is wanted as many
/// times longer (or shorter) as its part is too slow (or too fast), three at most, and positions
/// are those whose steps come nearest to that while they stay near what was planned: a screened
/// Poisson equation. It changes swings of a second wholly, of four seconds by half, and slow ways
/// hardly. Bones change their lengths by it, which is a fit's to mend; who stands still goes on to.
/// The root stays, and the first column; so does the last one where it is `held` by a key.
Eigen::MatrixXd PaceParts(const BodyPartWeights& weights, const VelocityFactorTrack& factors,
                          const Eigen::MatrixXd& planned, bool held);

}  // namespace choreo
