#pragma once

#include <Eigen/Core>
#include <span>

#include "model/metrics/joint_track.h"

/// Distances of a generated dance from the real one, frame by frame. All throw
/// Error(kInvalidArgument) if the frame counts differ.
namespace choreo {

/// L2P: the distance of global joint positions, mean over joints and frames, metres. Paper F, Eq.
/// 10 (after Harvey et al. 2020) takes the norm over all joints together. The mean per joint is
/// easier to interpret, and has similar ratios to a baseline.
double L2P(const JointTrack& danced, const JointTrack& real);

/// Key pose distance, paper F, 4.5.3: the mean *squared* distance of joint positions, m^2, of two
/// poses [3, joints].
double KeyPoseDistance(const Eigen::Matrix3Xd& danced, const Eigen::Matrix3Xd& real);

/// Global joint rotations as unit quaternions, [4 * joints, frames]. Signs are continuous from
/// frame to frame, and the first frame's scalar parts are not negative.
Eigen::MatrixXd GlobalQuaternions(const Skeleton& skeleton, std::span<const Pose> poses);

/// L2Q, Harvey et al. 2020, Section 5: the norm of the difference of all global joint quaternions,
/// mean over frames; no unit. A quaternion and its negative are the same rotation, so the nearer
/// one counts.
double L2Q(const Eigen::MatrixXd& danced, const Eigen::MatrixXd& real);

/// Normalized power spectrum similarity (Gopalakrishnan et al. 2019, Section 4.1; of transitions:
/// Harvey et al. 2020): the earth mover's distance between the power spectra of a feature in both
/// motions (GlobalQuaternions), averaged over windows and features, weighted by the real motion's
/// power. 0 means equal; no unit. Holds the weighted sum and the weights separately, for means over
/// windows.
struct Npss {
  double sum = 0, weight = 0;
};
Npss MeasureNpss(const Eigen::MatrixXd& danced, const Eigen::MatrixXd& real);

}  // namespace choreo
