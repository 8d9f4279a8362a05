#pragma once

#include <Eigen/Core>

#include "model/metrics/joint_track.h"
#include "model/motion/controls/velocity_factors.h"

/// Measures how well a transition follows its controls: the three figures of paper C, Section 4.3,
/// Eq. 12-16. Each function returns one number per transition. LRP is the mean over transitions;
/// AVF (Eq. 13) and ART (Eq. 15) are the share of transitions below a tolerance. All throw
/// Error(kInvalidArgument) for no frames or different frame counts. Pure, thread-safe.
namespace choreo {

/// LRP of one transition, Eq. 12: the L2 norm, over all joints but the root, of the difference of
/// root-relative positions (along world axes), mean over frames; metres (the paper: cm).
double RootRelativeDistance(const JointTrack& danced, const JointTrack& real);

/// Velocity factors, metres a frame: [kBodyParts, frames].
using SpeedTrack = Eigen::Matrix<double, kBodyParts, Eigen::Dynamic>;

/// The velocity factors of each step of a track that begins with the frame before the transition.
SpeedTrack TrackPartSpeeds(const BodyPartWeights& weights, const JointTrack& track);

/// g_v of one transition, Eq. 14: the absolute difference of measured and requested velocity
/// factors, mean over frames and parts; metres a frame.
double VelocityDeviation(const SpeedTrack& danced, const SpeedTrack& requested);

/// g_r of one transition, Eq. 16: the distance of the root (joint 0) from its requested position,
/// mean over frames, metres. `requested` is [3, frames].
double RootDeviation(const JointTrack& danced, const Eigen::Matrix3Xd& requested);

/// The tremor of a dance (our measure): the share above kTremorHz of the energy of all joint
/// velocities relative to the root, 0 to 1; 0 if nothing moves. Subtracts each velocity's mean and
/// applies a Hann window. Throws for fewer than 9 frames, too few to resolve 4 Hz.
inline constexpr double kTremorHz = 4;
double TremorShare(const JointTrack& track, double fps);

}  // namespace choreo
