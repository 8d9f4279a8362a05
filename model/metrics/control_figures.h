#pragma once

#include <Eigen/Core>

#include "model/metrics/joint_track.h"
#include "model/motion/velocity_factors.h"

/// How well a transition does what it was asked: the three figures of paper C, Section 4.3, Eq.
/// 12-16. Each comes as one number a transition; LRP is then averaged over transitions, AVF (Eq.
/// 13) and ART (Eq. 15) are the share of transitions below a tolerance. All throw
/// Error(kInvalidArgument) for no frames, or where the frames of the two do not match. Pure,
/// thread-safe.
namespace choreo {

/// LRP of one transition, Eq. 12: the L2 distance of the root-relative positions of all joints but
/// the root at once, mean over frames; metres (the paper: cm). Root-relative: less the root's
/// position, axes the world's.
double RootRelativeDistance(const JointTrack& danced, const JointTrack& real);

/// Velocity factors, metres a frame: [kBodyParts, frames].
using FactorTrack = Eigen::Matrix<double, kBodyParts, Eigen::Dynamic>;

/// Those of each step of a track, which begins with the frame before the transition.
FactorTrack TrackVelocityFactors(const BodyPartWeights& weights, const JointTrack& track);

/// g_v of one transition, Eq. 14: the absolute difference of danced and asked velocity factors,
/// mean over frames and parts; metres a frame.
double VelocityDeviation(const FactorTrack& danced, const FactorTrack& asked);

/// g_r of one transition, Eq. 16: the distance of the root from where it was asked to be, mean over
/// frames, metres. `asked` is [3, frames]. Joint 0 is the root.
double RootDeviation(const JointTrack& danced, const Eigen::Matrix3Xd& asked);

/// How much a dance trembles, ours: of the energy of the velocities of all joints from the root, at
/// `fps` frames a second, the share above kTremorHz, 0 to 1; 0 where nothing moves. Each velocity
/// counts less their mean, under a Hann window. Throws for fewer than 9 frames: less than that
/// tells nothing of 4 Hz.
inline constexpr double kTremorHz = 4;
double TremorShare(const JointTrack& track, double fps);

}  // namespace choreo
