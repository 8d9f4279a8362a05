#pragma once

#include <Eigen/Core>

#include "model/metrics/joint_track.h"

namespace choreo {

/// Geometric features of a motion (Müller et al. 2005, "Efficient content-based retrieval of motion
/// capture data"), [32]: the share of frames in which a statement about the body is true, such as
/// "the right hand moves upwards, as seen by the dancer" or "the left knee is bent". The features
/// of FID_g and Div_g (Li et al. 2021); their choice and thresholds, in units of the dancer's upper
/// arm, shoulders and hips, are fairmotion's.
///
/// Throws Error(kInvalidArgument) for fewer than two frames or a skeleton without the joints.
Eigen::VectorXd GeometricFeatures(const Skeleton& skeleton, const JointTrack& track, double fps);

inline constexpr int kGeometricFeatures = 32;

/// Whether the skeleton has the joints that the statements name.
bool HasGeometricFeatures(const Skeleton& skeleton);

}  // namespace choreo
